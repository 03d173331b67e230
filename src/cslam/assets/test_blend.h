// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cslam {

// Writes small Blender files for tests: structs are described as in C, blocks filled field by
// field.
class TestBlend {
 public:
  // fields: {"float", "co[3]"}, ...; structs must be described before they are used in others.
  void Describe(const std::string& type,
                const std::vector<std::pair<std::string, std::string>>& fields) {
    Layout layout;
    for (const auto& [field_type, declarator] : fields) {
      const bool is_pointer = declarator.starts_with('*');
      std::size_t count = 1;
      for (std::size_t at = declarator.find('['); at != std::string::npos;
           at = declarator.find('[', at + 1))
        count *= std::stoul(declarator.substr(at + 1));
      const std::size_t size = is_pointer ? 8 : SizeOf(field_type);
      const std::string name =
          declarator.substr(declarator.find_first_not_of('*'),
                            declarator.find('[') - declarator.find_first_not_of('*'));
      layout.offsets[name] = {layout.size, size};
      layout.size += size * count;
      layout.fields.emplace_back(TypeIndex(field_type), NameIndex(declarator));
    }
    sizes_[type] = layout.size;
    layout.type = TypeIndex(type);
    order_.push_back(type);
    layouts_[type] = layout;
  }

  // A block of `count` structs; returns its address.
  std::uint64_t Add(const std::string& code, const std::string& type, std::size_t count = 1) {
    blocks_.push_back({code, type, std::string(layouts_.at(type).size * count, '\0'), count});
    return 0x1000 * blocks_.size();
  }
  std::uint64_t AddBytes(const std::string& bytes) {
    blocks_.push_back({"DATA", order_.front(), bytes, 1});
    return 0x1000 * blocks_.size();
  }

  template <typename T>
  void Set(std::uint64_t address, const std::string& field, T value, std::size_t index = 0,
           std::size_t element = 0) {
    Block& block = blocks_[address / 0x1000 - 1];
    const Layout& layout = layouts_.at(block.type);
    const auto [offset, size] = layout.offsets.at(field);
    std::memcpy(block.bytes.data() + element * layout.size + offset + index * size, &value,
                sizeof value);
  }
  void SetText(std::uint64_t address, const std::string& field, std::string_view text,
               std::size_t skip = 0) {
    Block& block = blocks_[address / 0x1000 - 1];
    const std::size_t offset = layouts_.at(block.type).offsets.at(field).first + skip;
    std::memcpy(block.bytes.data() + offset, text.data(), text.size());
  }

  std::string Bytes() const {
    std::string out = "BLENDER-v274";
    const auto put_block = [&](const std::string& code, std::size_t layout, std::uint64_t address,
                               std::size_t count, const std::string& bytes) {
      out += code + std::string(4 - code.size(), '\0');
      Put(out, bytes.size(), 4);
      Put(out, address, 8);
      Put(out, layout, 4);
      Put(out, count, 4);
      out += bytes;
    };
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      std::size_t layout = 0;
      while (order_[layout] != blocks_[i].type)
        ++layout;
      put_block(blocks_[i].code, layout, 0x1000 * (i + 1), blocks_[i].count, blocks_[i].bytes);
    }
    put_block("DNA1", 0, 1, 1, Dna());
    put_block("ENDB", 0, 0, 0, "");
    return out;
  }

 private:
  struct Layout {
    std::size_t type = 0;
    std::size_t size = 0;
    std::vector<std::pair<std::size_t, std::size_t>> fields;             // type, name
    std::map<std::string, std::pair<std::size_t, std::size_t>> offsets;  // offset, entry size
  };
  struct Block {
    std::string code;
    std::string type;
    std::string bytes;
    std::size_t count = 1;
  };

  static void Put(std::string& out, std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i)
      out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
  std::size_t SizeOf(const std::string& type) const {
    if (type == "char") return 1;
    if (type == "short") return 2;
    if (type == "int" || type == "float") return 4;
    return type == "void" ? 0 : sizes_.at(type);
  }
  static std::size_t IndexIn(std::vector<std::string>& words, const std::string& word) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == word) return i;
    }
    words.push_back(word);
    return words.size() - 1;
  }
  std::size_t TypeIndex(const std::string& type) { return IndexIn(types_, type); }
  std::size_t NameIndex(const std::string& name) { return IndexIn(names_, name); }

  std::string Dna() const {
    std::string out = "SDNANAME";
    const auto align = [&] { out.resize((out.size() + 3) / 4 * 4, '\0'); };
    const auto put_words = [&](const std::vector<std::string>& words) {
      Put(out, words.size(), 4);
      for (const std::string& word : words)
        out += word + '\0';
      align();
    };
    put_words(names_);
    out += "TYPE";
    put_words(types_);
    out += "TLEN";
    for (const std::string& type : types_)
      Put(out, SizeOf(type), 2);
    align();
    out += "STRC";
    Put(out, order_.size(), 4);
    for (const std::string& type : order_) {
      const Layout& layout = layouts_.at(type);
      Put(out, layout.type, 2);
      Put(out, layout.fields.size(), 2);
      for (const auto& [field_type, name] : layout.fields) {
        Put(out, field_type, 2);
        Put(out, name, 2);
      }
    }
    return out;
  }

  std::vector<std::string> types_;
  std::vector<std::string> names_;
  std::vector<std::string> order_;
  std::map<std::string, std::size_t> sizes_;
  std::map<std::string, Layout> layouts_;
  std::vector<Block> blocks_;
};

}  // namespace cslam
