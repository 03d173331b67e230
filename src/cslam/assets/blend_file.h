// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cslam {

class BlendFile;

// One struct in a .blend file. Fields are found by their names in the file's own description of
// its structs, so that files of different Blender versions read alike. All functions throw Error
// that names file, struct and field if there is no such field or the file is damaged.
class BlendStruct {
 public:
  std::string_view type() const;
  bool Has(std::string_view field) const;

  // A number of any type, or entry `index` of an array of them (rows of matrices on end).
  double Number(std::string_view field, std::size_t index = 0) const;
  int Integer(std::string_view field, std::size_t index = 0) const;
  std::string Text(std::string_view field) const;
  BlendStruct Member(std::string_view field) const;  // a struct within this one

  // Where the file says the pointed-to block was in memory; 0: nowhere.
  std::uint64_t Address(std::string_view field, std::size_t index = 0) const;
  // What the pointer points to, if it is in the file.
  std::optional<BlendStruct> Follow(std::string_view field, std::size_t index = 0) const;
  // The first `count` structs the pointer points to; they must be there.
  std::vector<BlendStruct> Array(std::string_view field, int count) const;
  // The members of a linked list, a field of type ListBase.
  std::vector<BlendStruct> List(std::string_view field) const;

 private:
  friend class BlendFile;
  struct Field;
  BlendStruct(const BlendFile* file, std::size_t layout, std::size_t offset)
      : file_(file), layout_(layout), offset_(offset) {}

  const BlendFile* file_;
  std::size_t layout_;  // which struct
  std::size_t offset_;  // bytes from the file's start
};

// Blender's own file format, as much of it as reading meshes and bones takes: any little-endian
// version, plain or compressed with gzip. The structs of a file live as long as the file.
class BlendFile {
 public:
  // Throws Error that names the path: missing, not a .blend file, damaged, compressed otherwise.
  explicit BlendFile(const std::filesystem::path& path);
  BlendFile(const BlendFile&) = delete;
  BlendFile& operator=(const BlendFile&) = delete;

  int version() const { return version_; }  // 274 for Blender 2.74
  const std::string& name() const { return name_; }

  // All blocks with a code: "OB" objects, "ME" meshes, "AR" armatures, "IM" images, ...
  std::vector<BlendStruct> Blocks(std::string_view code) const;
  std::optional<BlendStruct> At(std::uint64_t address, std::size_t index = 0) const;
  // An entry of an array of pointers.
  std::uint64_t PointerAt(std::uint64_t address, std::size_t index) const;
  std::string_view BytesAt(std::uint64_t address, std::size_t size) const;

 private:
  friend class BlendStruct;
  struct Block {
    std::string code;
    std::size_t layout = 0;
    std::size_t offset = 0;
    std::size_t size = 0;
    std::size_t count = 0;
  };
  struct Field {
    std::string name;  // without stars and brackets
    std::string type;
    bool is_pointer = false;
    std::size_t count = 1;
    std::size_t offset = 0;
    std::size_t size = 0;  // of one entry
  };
  struct Layout {
    std::string type;
    std::size_t size = 0;
    std::vector<Field> fields;
  };

  class Cursor;
  void ReadBlocks();
  void ReadLayouts(const Block& dna);
  void AddLayouts(Cursor cursor, const std::vector<std::string>& names,
                  const std::vector<std::string>& types, const std::vector<std::size_t>& sizes);
  const Block* BlockAt(std::uint64_t address) const;
  const Field& FieldOf(std::size_t layout, std::string_view field) const;
  std::size_t LayoutOf(std::string_view type) const;
  std::uint64_t Unsigned(std::size_t offset, std::size_t size) const;
  [[noreturn]] void ThrowDamaged(std::string_view what) const;

  std::string name_;
  std::string bytes_;
  int version_ = 0;
  std::size_t pointer_size_ = 8;
  std::vector<Block> blocks_;                      // in the file's order
  std::map<std::uint64_t, std::size_t> block_at_;  // by address
  std::vector<Layout> layouts_;
};

}  // namespace cslam
