#include "document/text/node.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/edit_distance.h"
#include "document/text/data_error.h"

namespace stablecut::document {
namespace {

// The name without the unit words at its end: depth_mm -> depth, k2_n_m_per_rad -> k2.
std::string_view stem(std::string_view name) {
  static constexpr std::array<std::string_view, 42> kUnits = {
      "hz",  "khz", "mhz", "rpm", "rps", "deg", "rad", "s",   "ms",      "us",  "min", "m",  "mm",   "um",
      "nm",  "cm",  "in",  "mm2", "mm3", "m2",  "m3",  "s2",  "n",       "kn",  "mn",  "pa", "mpa",  "gpa",
      "kpa", "kg",  "g",   "per", "j",   "w",   "kw",  "nmm", "percent", "pct", "db",  "v",  "mrad", "urad"};
  for (;;) {
    const auto end = name.rfind('_');
    if (end == std::string_view::npos || end == 0) return name;
    if (std::find(kUnits.begin(), kUnits.end(), name.substr(end + 1)) == kUnits.end()) return name;
    name = name.substr(0, end);
  }
}

}  // namespace

Node::Node(const Json& value, const Source& source, std::string pointer)
    : value_(&value), source_(&source), pointer_(std::move(pointer)) {}

void Node::fail(const std::string& expected) const {
  std::string value;
  if (value_->is_object())
    value = "an object";
  else if (value_->is_array())
    value = "a list of " + std::to_string(value_->size());
  else
    value = value_->dump(-1, ' ', false, Json::error_handler_t::replace);
  throw DataError(source_->name, pointer_.empty() ? "/" : pointer_, value, expected);
}

std::optional<Node> Node::find(std::string_view name) const {
  if (!value_->is_object()) fail("expected an object");
  const auto found = value_->find(std::string(name));
  if (found == value_->end()) return std::nullopt;
  return Node(*found, *source_, pointer_step(pointer_, std::string(name)));
}

Node Node::at(std::string_view name) const {
  if (auto found = find(name)) return *found;
  throw DataError(source_->name, pointer_step(pointer_, std::string(name)), "",
                  "missing: expected this field");
}

void Node::check_names(std::initializer_list<std::string_view> known) const { check_known(known); }

void Node::check_document_names(std::initializer_list<std::string_view> known) const {
  std::vector<std::string_view> all = {"format", "label", "provenance"};
  all.insert(all.end(), known.begin(), known.end());
  check_known(all);
}

void Node::check_known(const std::vector<std::string_view>& known) const {
  if (!value_->is_object()) fail("expected an object");
  for (auto member = value_->begin(); member != value_->end(); ++member) {
    const std::string& name = member.key();
    if (std::find(known.begin(), known.end(), name) != known.end() || name.starts_with("x_")) continue;
    // The same quantity in another unit is nearer than any other name.
    const auto distance = [&](std::string_view candidate) {
      return stem(name) == stem(candidate) ? 0 : edits_between(name, candidate);
    };
    const std::string_view nearest =
        *std::min_element(known.begin(), known.end(),
                          [&](std::string_view a, std::string_view b) { return distance(a) < distance(b); });
    throw DataError(
        source_->name, pointer_step(pointer_, name), "",
        "unknown field: expected " + std::string(nearest) + " (a field of your own starts with x_)");
  }
}

double Node::number(const Bound& bound) const {
  const std::string expected = std::string("expected ") + bound.words;
  if (!value_->is_number()) fail(expected);
  const auto value = value_->get<double>();
  const bool inside = std::isfinite(value) &&
                      (bound.open_least ? value > bound.least : value >= bound.least) &&
                      (bound.open_most ? value < bound.most : value <= bound.most);
  if (!inside) fail(expected);
  if (std::abs(value) > kLargestNumber) fail("expected a number of at most 1e100 in size");
  if (bound.least == 0 && value != 0 && value < 1 / kLargestNumber)
    fail(bound.open_least ? "expected a number of at least 1e-100"
                          : "expected 0 or a number of at least 1e-100");
  return value;
}

int Node::integer(int least, int most) const {
  const std::string expected =
      "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  if (!value_->is_number()) fail(expected);
  const auto value = value_->get<double>();
  if (!(value >= least && value <= most) || value != std::floor(value)) fail(expected);
  return static_cast<int>(value);
}

bool Node::boolean() const {
  if (!value_->is_boolean()) fail("expected true or false");
  return value_->get<bool>();
}

std::string Node::text() const {
  if (!value_->is_string()) fail("expected a text");
  return value_->get<std::string>();
}

std::string Node::word(std::initializer_list<std::string_view> words) const {
  std::string expected = "expected";
  for (const auto& word : words) {
    if (value_->is_string() && value_->get_ref<const std::string&>() == word) return std::string(word);
    expected += (expected == "expected" ? " \"" : " or \"") + std::string(word) + '"';
  }
  fail(expected);
}

Eigen::VectorXd Node::numbers(const Bound& bound) const {
  if (!value_->is_array()) fail("expected a list of numbers");
  Eigen::VectorXd result(value_->size());
  Eigen::Index i = 0;
  for (const Json& item : *value_) {
    // The common case without building a pointer.
    const double value = item.is_number() ? item.get<double>() : std::numeric_limits<double>::quiet_NaN();
    const bool inside =
        std::abs(value) <= kLargestNumber && value > bound.least + 1 / kLargestNumber && value < bound.most;
    result[i] =
        inside ? value : Node(item, *source_, pointer_step(pointer_, std::to_string(i))).number(bound);
    ++i;
  }
  return result;
}

std::complex<double> Node::complex() const {
  if (!value_->is_array() || value_->size() != 2) fail("expected a complex number [re, im]");
  const auto parts = items();
  return {parts[0].number(), parts[1].number()};
}

std::vector<Node> Node::items(std::size_t least) const {
  if (!value_->is_array()) fail("expected a list");
  if (value_->size() < least) fail("expected a list of at least " + std::to_string(least));
  std::vector<Node> result;
  for (std::size_t i = 0; i < value_->size(); ++i) {
    result.emplace_back((*value_)[i], *source_, pointer_step(pointer_, std::to_string(i)));
  }
  return result;
}

Node document_root(const Json& value, const Source& source, std::string_view kind, std::string pointer) {
  Node root(value, source, std::move(pointer));
  const std::string format = root.at("format").text();
  const std::string wanted = "stablecut/" + std::string(kind) + "/1";
  if (format != wanted) root.at("format").fail("expected \"" + wanted + "\"");
  if (const auto label = root.find("label")) label->text();
  return root;
}

}  // namespace stablecut::document
