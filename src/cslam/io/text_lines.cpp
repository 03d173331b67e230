// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/text_lines.h"

#include "cslam/util/check.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <system_error>

namespace cslam {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\r\v\f";

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::vector<std::string> SplitFields(std::string_view line) {
  std::vector<std::string> fields;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return fields;
    line.remove_prefix(begin);
    const std::size_t length = std::min(line.find_first_of(kBlanks), line.size());
    fields.emplace_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

}  // namespace

std::vector<TextLine> ReadTextLines(const std::filesystem::path& path) {
  return SplitTextLines(ReadBytes(path, "list"));
}

std::vector<TextLine> SplitTextLines(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<TextLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    TextLine line{.number = number, .fields = SplitFields(text.substr(0, end))};
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.fields.empty() && !line.fields[0].starts_with('#')) lines.push_back(std::move(line));
  }
  return lines;
}

std::string ReadBytes(const std::filesystem::path& path, std::string_view what) {
  const auto throw_reason = [&](int error_number) {
    throw Error("cannot read {} '{}': {}", what, path.string(),
                std::generic_category().message(error_number));
  };
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw_reason(errno);
  std::string bytes;
  std::string block(std::size_t{1} << 18, '\0');
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    bytes.append(block, 0, count);
  }
  if (std::ferror(file.get()) != 0) throw_reason(errno);
  return bytes;
}

std::string Excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string excerpt(text.substr(0, kLongest));
  for (char& c : excerpt) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.size() > kLongest ? excerpt + "..." : excerpt;
}

}  // namespace cslam
