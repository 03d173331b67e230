// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/blend_file.h"

#include "cslam/assets/gzip.h"
#include "cslam/io/text_lines.h"
#include "cslam/util/check.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace cslam {
namespace {

constexpr std::size_t kHeaderSize = 12;
constexpr int kMaxListLength = 1'000'000;  // longer: a damaged file's circle

// "*mat[18]" and the like: stars, brackets and what is left.
struct Declarator {
  std::string name;
  bool is_pointer = false;
  std::size_t count = 1;
};

Declarator ParseDeclarator(std::string_view text) {
  Declarator result;
  result.is_pointer = text.starts_with('*') || text.starts_with('(');
  const std::size_t begin = text.find_first_not_of("*(");
  if (begin == std::string_view::npos) return result;
  text.remove_prefix(begin);
  result.name = text.substr(0, text.find_first_of("[)"));
  for (std::size_t open = text.find('['); open != std::string_view::npos;
       open = text.find('[', open + 1)) {
    std::size_t length = 0;
    for (std::size_t i = open + 1; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
      length = length * 10 + static_cast<std::size_t>(text[i] - '0');
    result.count *= length;
  }
  return result;
}

}  // namespace

// Reads the description of the structs from its beginning to its end.
class BlendFile::Cursor {
 public:
  Cursor(const BlendFile& file, std::size_t begin, std::size_t end)
      : file_(file), begin_(begin), at_(begin), end_(end) {}

  void Expect(std::string_view mark) {
    at_ = begin_ + (at_ - begin_ + 3) / 4 * 4;
    if (Take(mark.size()) != mark) file_.ThrowDamaged("its description of structs");
  }
  std::string_view Take(std::size_t size) {
    if (size > end_ - at_) file_.ThrowDamaged("its description of structs");
    at_ += size;
    return std::string_view(file_.bytes_).substr(at_ - size, size);
  }
  std::size_t Number(std::size_t size) {
    Take(size);
    return file_.Unsigned(at_ - size, size);
  }
  std::vector<std::string> Words() {
    std::vector<std::string> words;
    for (std::size_t n = Number(4); n > 0; --n) {
      const std::size_t stop = file_.bytes_.find('\0', at_);
      if (stop >= end_) file_.ThrowDamaged("its description of structs");
      words.emplace_back(Take(stop - at_));
      Take(1);
    }
    return words;
  }

 private:
  const BlendFile& file_;
  std::size_t begin_;
  std::size_t at_;
  std::size_t end_;
};

BlendFile::BlendFile(const std::filesystem::path& path)
    : name_(path.string()), bytes_(ReadBytes(path, "Blender file")) {
  if (IsGzip(bytes_)) bytes_ = Gunzip(bytes_, name_);
  if (bytes_.starts_with("\x28\xb5\x2f\xfd")) {
    throw Error("'{}' is compressed with zstd; save it uncompressed from Blender", name_);
  }
  if (!bytes_.starts_with("BLENDER") || bytes_.size() < kHeaderSize) {
    throw Error("'{}' is not a Blender file", name_);
  }
  pointer_size_ = bytes_[7] == '_' ? 4 : 8;
  if (bytes_[8] != 'v') throw Error("'{}' is a big-endian Blender file; save it anew", name_);
  for (std::size_t i = 9; i < kHeaderSize; ++i) {
    if (bytes_[i] < '0' || bytes_[i] > '9') ThrowDamaged("its version");
    version_ = version_ * 10 + (bytes_[i] - '0');
  }
  ReadBlocks();
}

void BlendFile::ThrowDamaged(std::string_view what) const {
  throw Error("Blender file '{}' is damaged: {} cannot be read; fetch it again", name_, what);
}

std::uint64_t BlendFile::Unsigned(std::size_t offset, std::size_t size) const {
  if (size > bytes_.size() || offset > bytes_.size() - size) ThrowDamaged("a number past its end");
  std::uint64_t value = 0;
  for (std::size_t i = size; i > 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes_[offset + i - 1]);
  return value;
}

void BlendFile::ReadBlocks() {
  const std::size_t head_size = 16 + pointer_size_;
  std::size_t at = kHeaderSize;
  std::optional<Block> dna;
  while (true) {
    if (bytes_.size() - at < head_size) ThrowDamaged("a block past its end");
    Block block;
    block.code = bytes_.substr(at, 4);
    block.code.erase(std::min(block.code.find('\0'), block.code.size()));
    if (block.code == "ENDB") break;
    block.size = Unsigned(at + 4, 4);
    const std::uint64_t address = Unsigned(at + 8, pointer_size_);
    block.layout = Unsigned(at + 8 + pointer_size_, 4);
    block.count = Unsigned(at + 12 + pointer_size_, 4);
    block.offset = at + head_size;
    if (block.size > bytes_.size() - block.offset) ThrowDamaged("block " + block.code);
    at = block.offset + block.size;
    if (block.code == "DNA1") dna = block;
    block_at_.emplace(address, blocks_.size());
    blocks_.push_back(std::move(block));
  }
  if (!dna) ThrowDamaged("the missing description of structs");
  ReadLayouts(*dna);
}

void BlendFile::ReadLayouts(const Block& dna) {
  Cursor cursor(*this, dna.offset, dna.offset + dna.size);
  cursor.Expect("SDNA");
  cursor.Expect("NAME");
  const std::vector<std::string> names = cursor.Words();
  cursor.Expect("TYPE");
  const std::vector<std::string> types = cursor.Words();
  cursor.Expect("TLEN");
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < types.size(); ++i)
    sizes.push_back(cursor.Number(2));
  cursor.Expect("STRC");
  AddLayouts(cursor, names, types, sizes);
}

void BlendFile::AddLayouts(Cursor cursor, const std::vector<std::string>& names,
                           const std::vector<std::string>& types,
                           const std::vector<std::size_t>& sizes) {
  const auto pick = [&](std::size_t index, std::size_t count) {
    if (index >= count) ThrowDamaged("its description of structs");
    return index;
  };
  for (std::size_t n = cursor.Number(4); n > 0; --n) {
    Layout layout;
    const std::size_t type = pick(cursor.Number(2), types.size());
    layout.type = types[type];
    layout.size = sizes[type];
    std::size_t offset = 0;
    for (std::size_t fields = cursor.Number(2); fields > 0; --fields) {
      const std::size_t field_type = pick(cursor.Number(2), types.size());
      Declarator name = ParseDeclarator(names[pick(cursor.Number(2), names.size())]);
      const std::size_t size = name.is_pointer ? pointer_size_ : sizes[field_type];
      layout.fields.push_back(
          {std::move(name.name), types[field_type], name.is_pointer, name.count, offset, size});
      offset += size * name.count;
    }
    layouts_.push_back(std::move(layout));
  }
}

const BlendFile::Block* BlendFile::BlockAt(std::uint64_t address) const {
  const auto found = block_at_.find(address);
  return address == 0 || found == block_at_.end() ? nullptr : &blocks_[found->second];
}

const BlendFile::Field& BlendFile::FieldOf(std::size_t layout, std::string_view field) const {
  for (const Field& candidate : layouts_[layout].fields) {
    if (candidate.name == field) return candidate;
  }
  throw Error("Blender file '{}' (version {}): its struct {} has no field {}", name_, version_,
              layouts_[layout].type, field);
}

std::size_t BlendFile::LayoutOf(std::string_view type) const {
  for (std::size_t i = 0; i < layouts_.size(); ++i) {
    if (layouts_[i].type == type) return i;
  }
  throw Error("Blender file '{}' (version {}) knows no struct {}", name_, version_, type);
}

std::vector<BlendStruct> BlendFile::Blocks(std::string_view code) const {
  std::vector<BlendStruct> result;
  for (const Block& block : blocks_) {
    if (block.code != code) continue;
    if (block.layout >= layouts_.size()) ThrowDamaged("block " + block.code);
    result.push_back(BlendStruct(this, block.layout, block.offset));
  }
  return result;
}

std::optional<BlendStruct> BlendFile::At(std::uint64_t address, std::size_t index) const {
  const Block* block = BlockAt(address);
  if (block == nullptr || block->layout >= layouts_.size()) return std::nullopt;
  const std::size_t size = layouts_[block->layout].size;
  if ((index + 1) * size > block->size) return std::nullopt;
  return BlendStruct(this, block->layout, block->offset + index * size);
}

std::uint64_t BlendFile::PointerAt(std::uint64_t address, std::size_t index) const {
  const Block* block = BlockAt(address);
  if (block == nullptr || (index + 1) * pointer_size_ > block->size) return 0;
  return Unsigned(block->offset + index * pointer_size_, pointer_size_);
}

std::string_view BlendFile::BytesAt(std::uint64_t address, std::size_t size) const {
  const Block* block = BlockAt(address);
  if (block == nullptr || size > block->size) ThrowDamaged("packed data");
  return std::string_view(bytes_).substr(block->offset, size);
}

std::string_view BlendStruct::type() const {
  return file_->layouts_[layout_].type;
}

bool BlendStruct::Has(std::string_view field) const {
  const auto& fields = file_->layouts_[layout_].fields;
  return std::any_of(fields.begin(), fields.end(),
                     [&](const auto& candidate) { return candidate.name == field; });
}

double BlendStruct::Number(std::string_view field, std::size_t index) const {
  const BlendFile::Field& f = file_->FieldOf(layout_, field);
  if (f.is_pointer || index >= f.count) {
    throw Error("Blender file '{}': {}.{}[{}] is no number", file_->name_, type(), field, index);
  }
  const std::uint64_t bits = file_->Unsigned(offset_ + f.offset + index * f.size, f.size);
  if (f.type == "float") {
    float value = 0.0F;
    const auto word = static_cast<std::uint32_t>(bits);
    std::memcpy(&value, &word, sizeof value);
    return static_cast<double>(value);
  }
  if (f.type == "double") {
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  if (f.type.starts_with('u')) return static_cast<double>(bits);
  const std::size_t unused_bits = 64 - 8 * f.size;  // shifted out and in again: the sign
  return static_cast<double>(static_cast<std::int64_t>(bits << unused_bits) >> unused_bits);
}

int BlendStruct::Integer(std::string_view field, std::size_t index) const {
  const double number = Number(field, index);
  if (!(std::abs(number) <= std::numeric_limits<int>::max())) {
    throw Error("Blender file '{}': {}.{} = {} is out of range", file_->name_, type(), field,
                number);
  }
  return static_cast<int>(number);
}

std::string BlendStruct::Text(std::string_view field) const {
  const BlendFile::Field& f = file_->FieldOf(layout_, field);
  const std::size_t begin = offset_ + f.offset;
  if (f.is_pointer || f.size != 1 || begin + f.count > file_->bytes_.size()) {
    throw Error("Blender file '{}': {}.{} is no text", file_->name_, type(), field);
  }
  std::string text = file_->bytes_.substr(begin, f.count);
  text.erase(std::min(text.find('\0'), text.size()));
  return text;
}

BlendStruct BlendStruct::Member(std::string_view field) const {
  const BlendFile::Field& f = file_->FieldOf(layout_, field);
  if (f.is_pointer) {
    throw Error("Blender file '{}': {}.{} is a pointer", file_->name_, type(), field);
  }
  return {file_, file_->LayoutOf(f.type), offset_ + f.offset};
}

std::uint64_t BlendStruct::Address(std::string_view field, std::size_t index) const {
  const BlendFile::Field& f = file_->FieldOf(layout_, field);
  if (!f.is_pointer || index >= f.count) {
    throw Error("Blender file '{}': {}.{}[{}] is no pointer", file_->name_, type(), field, index);
  }
  return file_->Unsigned(offset_ + f.offset + index * f.size, f.size);
}

std::optional<BlendStruct> BlendStruct::Follow(std::string_view field, std::size_t index) const {
  return file_->At(Address(field, index));
}

std::vector<BlendStruct> BlendStruct::Array(std::string_view field, int count) const {
  const std::uint64_t address = Address(field);
  std::vector<BlendStruct> result;
  for (int i = 0; i < count; ++i) {
    const std::optional<BlendStruct> element = file_->At(address, static_cast<std::size_t>(i));
    if (!element) file_->ThrowDamaged(fmt::format("element {} of {}.{}", i, type(), field));
    result.push_back(*element);
  }
  return result;
}

std::vector<BlendStruct> BlendStruct::List(std::string_view field) const {
  std::vector<BlendStruct> result;
  std::optional<BlendStruct> element = Member(field).Follow("first");
  for (int i = 0; element; ++i) {
    if (i >= kMaxListLength) file_->ThrowDamaged(fmt::format("the list {}.{}", type(), field));
    result.push_back(*element);
    element = element->Follow("next");
  }
  return result;
}

}  // namespace cslam
