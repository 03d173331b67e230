// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/io/config.h"

#include "cslam/util/check.h"
#include "cslam/util/text_table.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace cslam {
namespace {

// Options as the tree their dots describe, in the order of description.
struct Node {
  std::string name;
  const OptionEntry* entry = nullptr;  // null for groups
  std::vector<Node> children;
};

Node& ChildCalled(Node& parent, std::string_view name) {
  const auto found = std::ranges::find(parent.children, name, &Node::name);
  if (found != parent.children.end()) return *found;
  return parent.children.emplace_back(Node{std::string(name), nullptr, {}});
}

Node MakeTree(const OptionList& list) {
  Node root;
  for (const OptionEntry& entry : list.entries()) {
    Node* node = &root;
    std::string_view rest = entry.key;
    while (true) {
      const std::size_t dot = rest.find('.');
      node = &ChildCalled(*node, rest.substr(0, dot));
      CSLAM_CHECK(node->entry == nullptr, "'{}' is a value and a group", entry.key);
      if (dot == std::string_view::npos) break;
      rest.remove_prefix(dot + 1);
    }
    CSLAM_CHECK(node->children.empty(), "'{}' is a value and a group", entry.key);
    node->entry = &entry;
  }
  return root;
}

std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string ReadWholeFile(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path))
    throw Error("'{}' is a folder; expected a YAML file with options", path.string());
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Error("cannot read options file '{}': {}", path.string(),
                std::generic_category().message(errno));
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

// Walks one YAML document and sets the options it names.
class YamlLoader {
 public:
  YamlLoader(const std::filesystem::path& path, OptionList& list) : path_(path), list_(list) {
    for (const OptionEntry& entry : list.entries()) {
      names_.push_back(entry.key);
      for (std::size_t dot = entry.key.find('.'); dot != std::string::npos;
           dot = entry.key.find('.', dot + 1)) {
        groups_.insert(entry.key.substr(0, dot));
      }
    }
    names_.insert(names_.end(), groups_.begin(), groups_.end());
  }

  void Load() {
    const std::vector<YAML::Node> documents = Parse();
    if (documents.size() > 1)
      throw ErrorAt(documents[1], "a second YAML document; options are read from one only");
    if (documents.empty() || documents[0].IsNull()) return;
    if (!documents[0].IsMap())
      throw ErrorAt(documents[0], "expected 'name: value' lines, as 'config --yaml' prints them");
    LoadGroup(documents[0], "");
  }

 private:
  Error ErrorAt(const YAML::Node& where, std::string_view message) const {
    return Error("{}:{}: {}", path_.string(), where.Mark().line + 1, message);
  }

  std::vector<YAML::Node> Parse() const {
    try {
      return YAML::LoadAll(ReadWholeFile(path_));
    } catch (const YAML::Exception& error) {
      throw Error("{}:{}: broken YAML: {}", path_.string(), error.mark.line + 1,
                  FirstLine(error.msg));
    }
  }

  // Only known groups are entered, so aliases that contain themselves end here too.
  void LoadGroup(const YAML::Node& group, const std::string& prefix) {
    for (const auto& item : group) {
      if (!item.first.IsScalar()) throw ErrorAt(item.first, "a key must be a plain name");
      const std::string key = prefix + item.first.Scalar();
      if (!seen_lines_.emplace(key, item.first.Mark().line + 1).second)
        throw ErrorAt(item.first, fmt::format("'{}' is set again; the first time in line {}", key,
                                              seen_lines_.at(key)));
      LoadItem(key, item.first, item.second);
    }
  }

  void LoadItem(const std::string& key, const YAML::Node& name, const YAML::Node& value) {
    if (groups_.contains(key)) {
      if (value.IsNull()) return;  // a group whose lines are all commented out
      if (!value.IsMap()) throw ErrorAt(name, fmt::format("'{}' is a group, not a value", key));
      LoadGroup(value, key + '.');
      return;
    }
    if (std::ranges::find(list_.entries(), key, &OptionEntry::key) == list_.entries().end()) {
      throw ErrorAt(name, fmt::format("unknown option '{}'; did you mean '{}'?", key,
                                      NearestName(key, names_)));
    }
    if (value.IsNull()) throw ErrorAt(name, fmt::format("'{}' has no value", key));
    if (!value.IsScalar()) throw ErrorAt(name, fmt::format("'{}' takes one plain value", key));
    try {
      list_.Set(key, value.Scalar());
    } catch (const Error& error) {
      throw ErrorAt(value, error.what());
    }
  }

  const std::filesystem::path path_;
  OptionList& list_;
  std::vector<std::string> names_;  // keys and groups, for suggestions
  std::set<std::string> groups_;
  std::map<std::string, int> seen_lines_;
};

bool IsNumber(const OptionEntry& entry) {
  return std::holds_alternative<int*>(entry.value) || std::holds_alternative<double*>(entry.value);
}

std::string RangeText(const OptionEntry& entry) {
  if (std::holds_alternative<bool*>(entry.value)) return "true or false";
  if (!IsNumber(entry)) return "text";
  return fmt::format("{} to {}", entry.range.min, entry.range.max);
}

std::string YamlScalar(const OptionEntry& entry) {
  std::string text = FormatValue(entry);
  if (!std::holds_alternative<std::string*>(entry.value)) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\x{:02x}", static_cast<int>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string YamlComment(const OptionEntry& entry) {
  if (!IsNumber(entry)) return entry.doc;
  const std::string unit = entry.unit.empty() ? "" : ' ' + entry.unit;
  return fmt::format("{} ({}{})", entry.doc, RangeText(entry), unit);
}

std::string YamlText(const Node& node, int depth) {
  std::string text;
  for (const Node& child : node.children) {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    if (child.entry == nullptr) {
      text += fmt::format("{}{}:\n{}", indent, child.name, YamlText(child, depth + 1));
    } else {
      text += fmt::format("{}{}: {}  # {}\n", indent, child.name, YamlScalar(*child.entry),
                          YamlComment(*child.entry));
    }
  }
  return text;
}

std::string EscapeMarkdown(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string MarkdownRow(const OptionEntry& entry) {
  const std::string value = FormatValue(entry);
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", entry.key,
                     value.empty() ? "(empty)" : '`' + value + '`', entry.unit, RangeText(entry),
                     EscapeMarkdown(entry.doc));
}

}  // namespace

void LoadYaml(const std::filesystem::path& path, OptionList& list) {
  YamlLoader(path, list).Load();
}

void ApplyOverrides(const std::vector<std::string>& assignments, OptionList& list) {
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Error("cannot set '{}': expected key=value", assignment);
    list.Set(assignment.substr(0, equals), assignment.substr(equals + 1));
  }
}

std::string DumpYaml(const OptionList& list) {
  return YamlText(MakeTree(list), 0);
}

std::string DumpTable(const OptionList& list, const OptionList& defaults) {
  CSLAM_CHECK(list.entries().size() == defaults.entries().size());
  TextTable table({{"option"}, {"value"}, {"unit"}, {"range"}, {"meaning"}});
  for (std::size_t i = 0; i < list.entries().size(); ++i) {
    const OptionEntry& entry = list.entries()[i];
    CSLAM_CHECK(entry.key == defaults.entries()[i].key);
    const std::string preset = FormatValue(defaults.entries()[i]);
    std::string value = FormatValue(entry);
    if (value != preset) value += fmt::format(" (default {})", preset.empty() ? "empty" : preset);
    table.AddRow({entry.key, value, entry.unit, RangeText(entry), entry.doc});
  }
  return table.Text();
}

std::string DumpMarkdown(const OptionList& list) {
  std::string text =
      "# Options\n\n"
      "<!-- Generated by `changing-slam config --markdown`; do not edit. -->\n\n"
      "Every option can stand in a YAML file (`--config FILE`; the dots become nested maps) or on\n"
      "the command line (`--set key=value`, which wins). `changing-slam config --yaml` prints a\n"
      "complete file to start from.\n";
  for (const Node& top : MakeTree(list).children) {
    text += fmt::format("\n## {}\n\n| option | default | unit | range | meaning |\n", top.name);
    text += "|---|---|---|---|---|\n";
    for (const OptionEntry& entry : list.entries()) {
      if (entry.key == top.name || entry.key.starts_with(top.name + '.'))
        text += MarkdownRow(entry);
    }
  }
  return text;
}

}  // namespace cslam
