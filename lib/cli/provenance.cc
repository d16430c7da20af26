#include "cli/provenance.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "document/text/label.h"

namespace stablecut::cli {

std::string sha256(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available");
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

namespace {

bool is_sha256(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// True for what provenance() writes. Anything else under that name is not carried into an output.
bool is_provenance(const document::Json& value) {
  const auto has = [](const document::Json& object, const char* name,
                      bool (document::Json::*is)()
                          const noexcept) { return object.contains(name) && (object[name].*is)(); };
  if (!value.is_object() || !has(value, "tool", &document::Json::is_string) ||
      !has(value, "version", &document::Json::is_string) ||
      !has(value, "arguments", &document::Json::is_array) ||
      !has(value, "inputs", &document::Json::is_array)) {
    return false;
  }
  const auto is_text = [](const document::Json& item) { return item.is_string(); };
  const auto is_input = [&](const document::Json& item) {
    return item.is_object() && has(item, "name", &document::Json::is_string) &&
           has(item, "sha256", &document::Json::is_string) && is_sha256(item["sha256"].get<std::string>()) &&
           (!item.contains("from") || is_provenance(item["from"]));
  };
  return std::all_of(value["arguments"].begin(), value["arguments"].end(), is_text) &&
         std::all_of(value["inputs"].begin(), value["inputs"].end(), is_input);
}

}  // namespace

ProvenanceInput provenance_input(const document::Source& source, const document::Json& document) {
  ProvenanceInput input{source.name, sha256(source.text), nullptr, document::label_of(document)};
  if (document.is_object()) {
    if (const auto found = document.find("provenance"); found != document.end() && is_provenance(*found)) {
      input.from = *found;
    }
  }
  return input;
}

std::string inherited_label(const std::vector<ProvenanceInput>& inputs) {
  std::vector<std::string> labels;
  for (const ProvenanceInput& input : inputs) labels.push_back(input.label);
  return document::joined_labels(labels);
}

document::Json provenance(const std::string& tool, const std::string& version,
                          const std::vector<std::string>& arguments,
                          const std::vector<ProvenanceInput>& inputs) {
  document::Json list = document::Json::array();
  for (const ProvenanceInput& input : inputs) {
    document::Json item = {{"name", input.name}, {"sha256", input.sha256}};
    if (!input.from.is_null()) item["from"] = input.from;
    list.push_back(std::move(item));
  }
  return {{"tool", tool}, {"version", version}, {"arguments", arguments}, {"inputs", std::move(list)}};
}

}  // namespace stablecut::cli
