#include "document/text/json_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

#include "document/text/data_error.h"
#include "document/text/plain_text.h"

namespace stablecut::document {
namespace {

constexpr std::size_t kDeepest = 200;  // levels of lists and objects

// Builds the value while it knows where it is, which the library's own builder does not tell.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(const Source& source) : source_(source) {}

  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& text) override {
    if (!std::isfinite(value)) fail(next_pointer(), text, "expected a finite number");
    return add(value);
  }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second) {
      fail(pointer_step(pointer(), name), "", "duplicate key: expected each name once");
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string& last_token,
                   const nlohmann::detail::exception&) override {
    if (source_.text.find_first_not_of(" \t\r\n") == std::string::npos) {
      fail("", "", "empty input: expected a JSON document");
    }
    const std::string_view before = std::string_view(source_.text).substr(0, position);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    std::string place = line_place(line);
    if (const std::string where = next_pointer(); !where.empty()) place += ": " + where;
    if (position > source_.text.size() || last_token.empty()) {
      fail(place, "", "the document ends here: expected the rest of it");
    }
    fail(place, whole_token(position, last_token), "not JSON: expected a value or punctuation of JSON");
  }

 private:
  struct Level {
    Json* value;
    std::string key;             // of the member being read
    std::set<std::string> keys;  // seen so far
  };

  [[noreturn]] void fail(const std::string& place, const std::string& value,
                         const std::string& expected) const {
    throw DataError(source_.name, place, value, expected);
  }

  // The reader stops at the first wrong letter (the a of nan): show the word that it stands in.
  std::string whole_token(std::size_t position, const std::string& last_token) const {
    const auto& text = source_.text;
    const auto is_word = [&](std::size_t i) {
      return std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '.' || text[i] == '-' ||
             text[i] == '+';
    };
    std::size_t from = std::min(position == 0 ? 0 : position - 1, text.size() - 1), to = from;
    if (!is_word(from)) return last_token;
    while (from > 0 && is_word(from - 1)) --from;
    while (to < text.size() && is_word(to)) ++to;
    return text.substr(from, to - from);
  }

  std::string pointer() const {
    std::string result;
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) result = step(result, levels_[i], 1);
    return result;
  }
  // Of the value that comes next.
  std::string next_pointer() const { return levels_.empty() ? "" : step(pointer(), levels_.back(), 0); }
  static std::string step(const std::string& from, const Level& level, std::size_t already_added) {
    if (level.value->is_array())
      return pointer_step(from, std::to_string(level.value->size() - already_added));
    return level.key.empty() ? from : pointer_step(from, level.key);
  }

  template <typename T>
  bool add(T&& value) {
    place(Json(std::forward<T>(value)));
    return true;
  }
  bool open(Json&& value) {
    if (levels_.size() >= kDeepest) {
      fail(levels_.front().key.empty() ? "/" : "/" + shown(levels_.front().key), "",
           "nested too deeply: expected at most " + std::to_string(kDeepest) + " levels");
    }
    levels_.push_back({place(std::move(value)), {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }
  Json* place(Json&& value) {
    if (levels_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Json& parent = *levels_.back().value;
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    return &(parent[levels_.back().key] = std::move(value));
  }

  const Source& source_;
  Json root_;
  std::vector<Level> levels_;
};

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) throw std::logic_error("a document cannot hold a number that is not finite");
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  out.append(buffer, end);
}

bool is_flat(const Json& value) {
  return std::none_of(value.begin(), value.end(), [](const Json& item) {
    return item.is_object() || (item.is_array() && (item.size() > 2 || !is_flat(item)));
  });
}

// Texts may hold what the command line gave, names of files that are not UTF-8 among them.
std::string written(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

void append(std::string& out, const Json& value, std::size_t indent) {
  const auto new_line = [&](std::size_t depth) {
    out += '\n';
    out.append(depth, ' ');
  };
  if (value.is_number_float()) {
    append_number(out, value.get<double>());
  } else if (!value.is_structured()) {
    out += written(value);
  } else if (value.empty()) {
    out += value.is_object() ? "{}" : "[]";
  } else if (value.is_array()) {
    // Numbers, and pairs such as complex numbers, stay on one line.
    const bool flat = is_flat(value);
    out += '[';
    bool first = true;
    for (const Json& item : value) {
      if (!first) out += flat ? ", " : ",";
      first = false;
      if (!flat) new_line(indent + 1);
      append(out, item, indent + 1);
    }
    if (!flat) new_line(indent);
    out += ']';
  } else {
    out += '{';
    bool first = true;
    for (const auto& [key, item] : value.items()) {
      if (!first) out += ',';
      first = false;
      new_line(indent + 1);
      out += written(Json(key)) + ": ";
      append(out, item, indent + 1);
    }
    new_line(indent);
    out += '}';
  }
}

}  // namespace

Json parse_json(const Source& source) {
  if (is_utf16(source.text)) throw DataError(source.name, "", "UTF-16 text", "expected UTF-8");
  Builder builder(source);
  Json::sax_parse(source.text, &builder);
  return builder.take();
}

std::string json_text(const Json& value) {
  std::string out;
  append(out, value, 0);
  out += '\n';
  return out;
}

}  // namespace stablecut::document
