// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/asset_fetch.h"

#include "cslam/assets/package_props.h"
#include "cslam/assets/procedural_props.h"
#include "cslam/assets/run_command.h"
#include "cslam/assets/zip_file.h"
#include "cslam/io/text_lines.h"
#include "cslam/util/atomic_file.h"
#include "cslam/util/check.h"

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace cslam {
namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerMb = 1e6;
constexpr std::string_view kManifest = "manifest.txt";

using SourceList = std::vector<AssetSource>;

// A folder that goes away with this, unless it has been given its final name.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    fs::remove_all(path_, error);
    fs::create_directories(path_, error);
    if (error) throw Error("cannot create '{}': {}", path_.string(), error.message());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Changes with the list of files (FNV-1a), so that a folder made for another one is made anew.
std::string FirstManifestLine(std::span<const AssetSource> sources) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const AssetSource& source : sources) {
    for (const char c :
         source.package + '\n' + source.file + '\n' + source.member + '\n' + source.target + '\n')
      hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  }
  return fmt::format("changing-slam-assets {:016x}", hash);
}

std::string FirstLineOf(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

[[noreturn]] void ThrowMissing(const std::string& package, const std::string& reason) {
  throw Error(
      "cannot get the Debian package '{}': {}; install it (sudo apt-get update && sudo "
      "apt-get install {}), or use --look procedural",
      package, reason, package);
}

void WriteAsset(const fs::path& path, const std::string& bytes) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) throw Error("cannot create '{}': {}", path.parent_path().string(), error.message());
  WriteFileAtomically(path, bytes, Durability::kRename);
}

void CopyMembers(ZipFile& archive, const AssetSource& source, const fs::path& root) {
  if (!source.member.ends_with('/')) {
    WriteAsset(root / source.target, archive.Read(source.member));
    return;
  }
  bool is_empty = true;
  for (const std::string& name : archive.Names()) {
    if (!name.starts_with(source.member)) continue;
    WriteAsset(root / source.target / name.substr(source.member.size()), archive.Read(name));
    is_empty = false;
  }
  if (is_empty) throw Error("it has no '{}'", source.member);
}

// share: where the package's files are. Throws Error with the reason alone.
void CopyPackage(const fs::path& share, const SourceList& sources, const fs::path& root) {
  std::map<std::string, ZipFile> archives;
  for (const AssetSource& source : sources) {
    const fs::path file = share / source.file;
    if (source.member.empty()) {
      WriteAsset(root / source.target, ReadBytes(file, "file"));
      continue;
    }
    auto archive = archives.find(source.file);
    if (archive == archives.end()) archive = archives.try_emplace(source.file, file).first;
    CopyMembers(archive->second, source, root);
  }
}

bool IsInstalled(const fs::path& share, const SourceList& sources) {
  for (const AssetSource& source : sources) {
    std::error_code ignored;
    if (!fs::is_regular_file(share / source.file, ignored)) return false;
  }
  return true;
}

double MegabytesIn(const fs::path& folder) {
  double bytes = 0.0;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code ignored;
    if (it->is_regular_file(ignored)) bytes += static_cast<double>(it->file_size(ignored));
  }
  return bytes / kBytesPerMb;
}

// The last line that apt-get marks as an error or, failing that, the last one.
std::string ReasonIn(const std::string& output) {
  std::string reason;
  bool is_error = false;
  std::size_t start = 0;
  while (start < output.size()) {
    const std::size_t end = std::min(output.find('\n', start), output.size());
    const std::string line = output.substr(start, end - start);
    start = end + 1;
    const bool marked = line.starts_with("E: ");
    if (line.empty() || (is_error && !marked)) continue;
    reason = marked ? line.substr(3) : line;
    is_error = is_error || marked;
  }
  return reason.empty() ? "no reason given" : Excerpt(reason);
}

// From the line that `apt-get download --print-uris` prints: 'address' name bytes hash.
double DownloadMegabytes(const std::string& package, const fs::path& folder) {
  const CommandResult result = RunCommand({"apt-get", "download", "--print-uris", package}, folder);
  if (result.exit_code == 127) ThrowMissing(package, "there is no apt-get on this system");
  if (result.exit_code != 0) ThrowMissing(package, ReasonIn(result.output));
  for (const TextLine& line : SplitTextLines(result.output)) {
    if (line.fields.size() < 3 || !line.fields[0].starts_with('\'')) continue;
    double bytes = 0.0;
    const std::string& text = line.fields[2];
    std::from_chars(text.data(), text.data() + text.size(), bytes);
    return bytes / kBytesPerMb;
  }
  return 0.0;
}

// What a command that prints a version says.
std::string VersionFrom(const std::vector<std::string>& command, const fs::path& folder) {
  const CommandResult result = RunCommand(command, folder);
  return result.exit_code == 0 && !result.output.empty() ? FirstLineOf(result.output) : "unknown";
}

// Fills folder/usr/share with the files that the sources name; returns the package's version.
std::string Download(const std::string& package, const SourceList& sources, const fs::path& folder,
                     const FetchCallback& progress) {
  const double total_mb = DownloadMegabytes(package, folder);
  const auto report = [&] {
    if (progress) progress({package, std::min(MegabytesIn(folder), total_mb), total_mb});
  };
  report();
  const CommandResult download = RunCommand({"apt-get", "download", package}, folder, report);
  fs::path deb;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".deb") deb = entry.path();
  }
  if (download.exit_code != 0 || deb.empty()) ThrowMissing(package, ReasonIn(download.output));
  std::set<std::string> files;
  for (const AssetSource& source : sources)
    files.insert("./usr/share/" + source.file);
  std::vector<std::string> command{
      "sh", "-c", "deb=$1; shift; dpkg-deb --fsys-tarfile \"$deb\" | tar -x -f - \"$@\"", "sh",
      deb.string()};
  command.insert(command.end(), files.begin(), files.end());
  const CommandResult unpacked = RunCommand(command, folder, report);
  if (unpacked.exit_code != 0) ThrowMissing(package, ReasonIn(unpacked.output));
  return VersionFrom({"dpkg-deb", "-f", deb.string(), "Version"}, folder);
}

// Copies a package's files to the folder in the making; returns its line of the manifest.
std::string AddPackage(const std::string& package, const SourceList& sources,
                       const FetchPlaces& places, const fs::path& root,
                       const FetchCallback& progress) {
  const TemporaryFolder temporary(root.string() + "." + package);
  fs::path share = places.share;
  const bool is_installed = IsInstalled(share, sources);
  std::string version;
  if (!is_installed) {
    if (!places.may_download)
      ThrowMissing(package, "it is not installed, and downloads are switched off");
    version = Download(package, sources, temporary.path(), progress);
    share = temporary.path() / "usr/share";
  } else {
    version = VersionFrom({"dpkg-query", "-W", "-f=${Version}", package}, temporary.path());
  }
  try {
    CopyPackage(share, sources, root);
  } catch (const Error& error) {
    ThrowMissing(package, error.what());
  }
  return fmt::format("{} {} {}", package, version, is_installed ? "installed" : "downloaded");
}

void PutInPlace(const fs::path& made, const fs::path& root) {
  const TemporaryFolder old(root.string() + ".old-" + std::to_string(getpid()));
  std::error_code error;
  if (fs::exists(root, error)) fs::rename(root, old.path() / "was", error);
  if (!error) fs::rename(made, root, error);
  if (error) throw Error("cannot create '{}': {}", root.string(), error.message());
}

}  // namespace

fs::path DefaultAssetRoot() {
  const char* const data_home = std::getenv("XDG_DATA_HOME");
  if (data_home != nullptr && *data_home == '/')
    return fs::path(data_home) / "changing-slam" / "assets";
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0')
    throw Error("no place for the assets: neither XDG_DATA_HOME nor HOME is set");
  return fs::path(home) / ".local" / "share" / "changing-slam" / "assets";
}

bool AssetsAreComplete(const fs::path& root, std::span<const AssetSource> sources) {
  std::error_code ignored;
  if (!fs::is_regular_file(root / kManifest, ignored)) return false;
  return FirstLineOf(ReadBytes(root / kManifest, "manifest")) == FirstManifestLine(sources);
}

AssetFolder FetchAssets(const FetchPlaces& places, std::span<const AssetSource> sources,
                        const FetchCallback& progress) {
  if (AssetsAreComplete(places.root, sources)) return AssetFolder(places.root);
  std::map<std::string, SourceList> by_package;
  for (const AssetSource& source : sources)
    by_package[source.package].push_back(source);
  const TemporaryFolder made(places.root.string() + ".tmp-" + std::to_string(getpid()));
  std::string manifest = FirstManifestLine(sources) + "\n";
  for (const auto& [package, list] : by_package)
    manifest += AddPackage(package, list, places, made.path(), progress) + "\n";
  WriteAsset(made.path() / kManifest, manifest);
  PutInPlace(made.path(), places.root);
  return AssetFolder(places.root);
}

Look ParseLook(std::string_view text) {
  if (text == "auto") return Look::kAuto;
  if (text == "packages") return Look::kPackages;
  if (text == "procedural") return Look::kProcedural;
  throw Error("there is no look '{}'; use auto, packages or procedural", text);
}

AssetStatus LoadOrFetchAssets(Look wish, const FetchPlaces& places, const FetchCallback& progress) {
  AssetStatus status;
  if (wish != Look::kProcedural) {
    try {
      status.folder = FetchAssets(places, AllAssetSources(), progress);
      status.props = std::make_shared<PackageProps>(*status.folder);
      return status;
    } catch (const Error& error) {
      if (wish == Look::kPackages) throw;
      status.folder.reset();
      status.note = fmt::format("procedural look: {}", error.what());
    }
  }
  status.props = std::make_shared<ProceduralProps>();
  return status;
}

AssetStatus LoadOrFetchAssets(Look wish, const FetchCallback& progress) {
  if (wish == Look::kProcedural) return LoadOrFetchAssets(wish, FetchPlaces{}, progress);
  return LoadOrFetchAssets(wish, FetchPlaces{.root = DefaultAssetRoot()}, progress);
}

}  // namespace cslam
