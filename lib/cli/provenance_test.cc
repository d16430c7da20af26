#include "cli/provenance.h"

#include <catch2/catch.hpp>

using namespace stablecut;
using namespace stablecut::cli;

TEST_CASE("SHA-256 of the standard's test messages") {
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("an input's own provenance is carried on") {
  const document::Source source{
      "a.json", R"({"provenance": {"tool": "t", "version": "1", "arguments": [], "inputs": []}})"};
  const document::Json result =
      provenance("u", "1", {"--x"}, {provenance_input(source, document::parse_json(source))});
  CHECK(result["inputs"][0]["from"]["tool"] == "t");
  CHECK(result["inputs"][0]["sha256"] == sha256(source.text));
  CHECK_FALSE(
      provenance("u", "1", {}, {provenance_input({"b.csv", "1,2"}, nullptr)})["inputs"][0].contains("from"));
}

TEST_CASE("what only calls itself a provenance is not carried on") {
  for (
      const char* text :
      {R"({"provenance": {"tool": "t", "version": "1", "arguments": [], "inputs": [{"name": "a", "sha256": "0g"}]}})",
       R"({"provenance": "hello"})", R"({"provenance": {}})", R"({"provenance": {"tool": "t"}})"}) {
    const document::Source source{"a.json", text};
    CHECK(provenance_input(source, document::parse_json(source)).from.is_null());
  }
}
