// SPDX-License-Identifier: BSD-3-Clause
#include "yaml/yaml_sections.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

#include "files/plain_text.hpp"

namespace ardrone_vslam {
namespace {

constexpr std::size_t kLargestFile_bytes = 256 * 1024;
constexpr const char* kUnreadable = "cannot be read; check the path";

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// Without the comment: a # at the beginning or behind a space, and in no quotes.
std::string withoutComment(const std::string& line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool is_after_space = i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t';
    if (quote == 0 && c == '#' && is_after_space) return line.substr(0, i);
    if (quote == 0 && (c == '"' || c == '\'')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    }
  }
  return line;
}

/// A scalar as written -> its text. @return false for what is no plain or quoted scalar
bool unquote(std::string& value) {
  if (value.empty()) return true;
  const char first = value.front();
  if (first == '"' || first == '\'') {
    if (value.size() < 2 || value.back() != first) return false;
    value = value.substr(1, value.size() - 2);
    return value.find(first) == std::string::npos && value.find('\\') == std::string::npos;
  }
  return std::strchr("{}&*!|>%@`[]", first) == nullptr && value.find(": ") == std::string::npos;
}

struct Line {
  std::size_t indent = 0;
  std::string key;
  std::string value;
};

bool split(const std::string& text, Line& line) {
  line.indent = text.find_first_not_of(' ');
  if (text[line.indent] == '\t') return false;
  const std::string content = trimmed(text);
  std::size_t colon = content.find(':');
  while (colon != std::string::npos && colon + 1 < content.size() && content[colon + 1] != ' ')
    colon = content.find(':', colon + 1);
  if (colon == std::string::npos || colon == 0) return false;
  line.key = trimmed(content.substr(0, colon));
  line.value = trimmed(content.substr(colon + 1));
  const bool is_list = !line.value.empty() && line.value.front() == '[';
  const bool is_item = line.key == "-" || line.key.compare(0, 2, "- ") == 0;
  return !is_item && unquote(line.key) && (is_list || unquote(line.value));
}

/// The lines of a text, comments cut off.
class Lines {
 public:
  explicit Lines(const std::string& text) : text_(text) {}

  bool next(std::string& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = withoutComment(text_.substr(at_, end - at_));
    at_ = end + 1;
    ++number_;
    return true;
  }
  int number() const { return number_; }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

/// A configuration's or calibration's text. @return what is wrong with the file, else nothing
std::string readText(const std::string& path, std::string& text) {
  struct stat status = {};  // a pipe or a device may never end
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    return "is no file but a folder, device or pipe; name a file";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return kUnreadable;
  std::array<char, 4096> part;
  text.clear();
  for (std::size_t got; (got = std::fread(part.data(), 1, part.size(), file.get())) > 0;)
    if (text.append(part.data(), got).size() > kLargestFile_bytes)
      return "is too large for a configuration or a calibration; check the path";
  return std::ferror(file.get()) == 0 ? faultOfText(text) : kUnreadable;
}

}  // namespace

namespace {

/// What the lines of a file make of it, one after the other.
class SectionReader {
 public:
  /// A line of key and value, the whole of its list. @return what is wrong with it
  std::string take(const Line& line) {
    return line.indent == 0 ? takeOutermost(line) : takeOfSection(line);
  }
  YamlSections& sections() { return sections_; }

 private:
  std::string takeOutermost(const Line& line) {
    section_.clear();
    indent_ = 0;
    open_key_ = line.value.empty() ? line.key : "";
    const bool is_new = open_key_.empty()
                            ? sections_[""].emplace(line.key, line.value).second
                            : sections_.emplace(open_key_, YamlSections::mapped_type{}).second;
    return is_new ? "" : "'" + line.key + "' is there twice";
  }

  std::string takeOfSection(const Line& line) {
    if (!open_key_.empty() && indent_ == 0) {
      section_ = open_key_;
      indent_ = line.indent;
    }
    if (section_.empty() || line.indent != indent_)
      return "'" + line.key + "' is indented as no key of a section is";
    const bool is_new = sections_[section_].emplace(line.key, line.value).second;
    return is_new ? "" : "'" + section_ + "/" + line.key + "' is there twice";
  }

  YamlSections sections_;
  std::string section_;
  std::string open_key_;    // a key without a value, which becomes a section by what follows
  std::size_t indent_ = 0;  // of the section's keys; 0: its first has not come
};

/// A list may go on over lines. @return what is wrong with it
std::string readList(Lines& lines, Line& line) {
  if (line.value.empty() || line.value.front() != '[') return {};
  std::string raw;
  while (line.value.back() != ']' && lines.next(raw)) line.value += " " + trimmed(raw);
  return line.value.back() == ']' ? "" : "the list of '" + line.key + "' has no ]";
}

}  // namespace

YamlSections readYamlSections(const std::string& text, std::vector<std::string>& faults) {
  SectionReader reader;
  Lines lines(text);
  std::string raw;
  while (lines.next(raw)) {
    if (trimmed(raw).empty() || raw == "---") continue;
    const int number = lines.number();
    const auto note = [&](const std::string& fault) {
      if (!fault.empty()) faults.push_back("line " + std::to_string(number) + ": " + fault);
    };
    Line line;
    if (!split(raw, line)) {
      note("'" + trimmed(raw) + "' is no 'key: value'");
      continue;
    }
    note(readList(lines, line));
    note(reader.take(line));
  }
  return std::move(reader.sections());
}

std::vector<std::string> listOf(const std::string& value) {
  const bool is_list = value.size() >= 2 && value.front() == '[' && value.back() == ']';
  if (!is_list) return {value};
  std::vector<std::string> items;
  std::string rest = value.substr(1, value.size() - 2);
  if (trimmed(rest).empty()) return items;
  for (std::size_t comma = 0; comma != std::string::npos;) {
    comma = rest.find(',');
    items.push_back(trimmed(rest.substr(0, comma)));
    if (comma != std::string::npos) rest = rest.substr(comma + 1);
  }
  return items;
}

bool toNumber(const std::string& text, double& value) {
  // strtod takes also "nan", "0x1p3" and leading spaces.
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) return false;
  char* end = nullptr;
  const double read = std::strtod(text.c_str(), &end);
  if (*end != '\0' || end == text.c_str() || !std::isfinite(read)) return false;
  value = read;
  return true;
}

bool toNumber(const std::string& text, int& value) {
  if (text.empty() || text.find_first_not_of("0123456789+-") != std::string::npos) return false;
  char* end = nullptr;
  errno = 0;
  const long read = std::strtol(text.c_str(), &end, 10);
  if (*end != '\0' || end == text.c_str() || errno != 0 || read < INT_MIN || read > INT_MAX)
    return false;
  value = static_cast<int>(read);
  return true;
}

bool toSwitch(const std::string& text, bool& value) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto isOneOf = [&](std::array<const char*, 4> names) {
    return std::find(names.begin(), names.end(), lower) != names.end();
  };
  value = isOneOf({"true", "yes", "on", "y"});
  return value || isOneOf({"false", "no", "off", "n"});
}

YamlSections readYamlFile(const std::string& path, std::vector<std::string>& faults) {
  std::string text;
  const std::string unread = readText(path, text);
  if (!unread.empty()) {
    faults.push_back(path + ": " + unread);
    return {};
  }
  std::vector<std::string> line_faults;
  YamlSections sections = readYamlSections(text, line_faults);
  for (const std::string& fault : line_faults) faults.push_back(path + ", " + fault);
  return sections;
}

}  // namespace ardrone_vslam
