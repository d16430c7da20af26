#include "document/measured/universal_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>

#include "document/measured/universal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::document;
using namespace stablecut::document::fixtures;
using Complex = std::complex<double>;

TEST_CASE("dataset 58 in whatever dress") {
  const std::string spread =
      "  1.0E+00  1.0E+00  2.0E+00\n  1.5E+00  3.0E+00 -4.0E+00\n  2.0E+00  5.0E-03  6.0E+03\n";
  const std::vector<double> numbers = {1, 2, 3, -4, 5e-3, 6e3};
  const std::vector<double> uneven = {1, 1, 2, 1.5, 3, -4, 2, 5e-3, 6e3};
  const auto binary = [&](bool single, bool big, bool even, const std::string& before_end) {
    return changed([&](Dataset& d) {
      d.values = bytes_of(even ? numbers : uneven, single, big);
      d.header = binary_header(big ? 2 : 1, d.values.size());
      d.layout = std::string("         ") + (single ? "5" : "6") + "         3         " +
                 (even ? "1" : "0") + "  1.00000E+00  5.00000E-01  0.00000E+00\n";
      d.values += before_end;
    });
  };
  const std::vector<std::pair<std::string, std::string>> variants = {
      {"as defined", changed([](Dataset&) {})},
      {"double precision", changed([](Dataset& d) {
         d.layout[9] = '6';
         d.values =
             "  1.000000000000E+00  2.000000000000E+00  3.000000000000E+00 -4.000000000000E+00\n"
             "  5.000000000000E-03  6.000000000000E+03\n";
       })},
      {"uneven", changed([&](Dataset& d) {
         d.layout = "         5         3         0  0.00000E+00  0.00000E+00  0.00000E+00\n";
         d.values = spread;
       })},
      {"uneven, filled up with zeros", changed([&](Dataset& d) {
         d.layout = "         5         3         0  0.00000E+00  0.00000E+00  0.00000E+00\n";
         d.values = spread + "  0.00000E+00  0.00000E+00  0.00000E+00\n";
       })},
      {"CRLF", crlf(changed([](Dataset&) {}))},
      {"D exponents",
       changed([](Dataset& d) { d.values = " 1.0D+00 2.0D0 3.D0 -.4d+1\n 5.0D-03 6.0D+03\n"; })},
      {"exponents of three digits", changed([](Dataset& d) {
         d.values = " 1.00000E+000 2.00000E+000 3.00000+000-4.00000E+000 5.00000-003 6.0E+003\n";
       })},
      {"no blank before a minus", changed([](Dataset& d) {
         d.values = "  1.00000E+00  2.00000E+00  3.00000E+00-4.00000E+00  5.00000E-03  6.00000E+03\n";
       })},
      {"plain numbers, tabs", changed([](Dataset& d) { d.values = "1\t2 3.\t-4 .005 +6000\n"; })},
      {"a short last line, blank lines", changed([](Dataset& d) {
         d.values = " 1.0E+00 2.0E+00 3.0E+00 -4.0E+00\n\n 5.0E-03 6.0E+03\n\n   \n";
       })},
      {"further records", changed([](Dataset& d) { d.values += "  7.00000E+00  8.00000E+00\nTRAILER 1\n"; })},
      {"no closing -1", changed([](Dataset& d) { d.end = ""; })},
      {"blanks around -1", changed([](Dataset& d) { d.end = "  -1   \n"; })},
      {"lines in front", "An analyser's remark\n\n" + changed([](Dataset&) {})},
      {"a byte-order mark", "\xEF\xBB\xBF" + changed([](Dataset&) {})},
      {"bytes that are not UTF-8", changed([](Dataset& d) {
         d.id = "M\xE4rz \xFF\xFE\nNONE\nNONE\nNONE\nNONE\n";
         d.ordinate = "        12    1    0    0 Acceleration         m/s\xB2                \n";
       })},
      {"other datasets",
       "    -1\n   151\nmodel\n  -1 not the end\n    -1\n    -1\n  2411\n         1         1\n    -1\n" +
           changed([](Dataset&) {}) + "    -1\n  9999\n    -1\n"},
      {"an opening -1 that is missing",
       "    -1\n   151\nmodel\n    -1\n" + changed([](Dataset&) {}).substr(7)},
      {"shifted columns", changed([](Dataset& d) {
         d.places = "4  0  0  0 AP 1 1 NONE 1 1\n";
         d.layout = "5 3 1 1.0 0.5 0\n";
         d.ordinate = "12 1 0 0 Acceleration  m/s^2\n";
         d.denominator = "13 0 1 0 Force  N\n";
       })},
      {"axis records that end before their columns", changed([](Dataset& d) {
         d.abscissa = "18 0 0 0 f  Hz\n";
         d.ordinate = "12 1 0 0 a  m/s^2\n";
         d.denominator = "13 0 1 0 F  N\n";
         d.z = "0\n";
       })},
      {"names with blanks", changed([](Dataset& d) {
         d.places = "    4         0    0         0  sine 5 Hz         1   1       NONE         1   1\n";
       })},
      {"no names", changed([](Dataset& d) {
         d.places = "    4         0    0         0                    1   1                    1   1\n";
       })},
      {"header numbers without blanks", changed([](Dataset& d) {
         d.layout = "         5         3         1  1.00000E+00  5.00000E-01-1.00000E+00\n";
       })},
      {"against both directions", changed([](Dataset& d) {
         d.places = "    4         0    0         0 NONE               1  -1 NONE               1  -1\n";
       })},
      {"general function over a force", changed([](Dataset& d) { d.places[4] = '0'; })},
      {"quantity and unit in one label", changed([](Dataset& d) {
         d.ordinate = "         1    0    0    0 Frequency Function   (1/N)*(m/s\xB2)       \n";
         d.denominator = "         0    0    0    0 NONE                 NONE                \n";
       })},
      {"quantity by label", changed([](Dataset& d) { d.ordinate.replace(0, 10, "         0"); })},
      {"kHz", changed([](Dataset& d) {
         d.layout = "         5         3         1  1.00000E-03  5.00000E-04  0.00000E+00\n";
         d.abscissa = "        18    0    0    0 Frequency            kHz                 \n";
       })},
      {"millimetres and millinewtons",
       "    -1\n   164\n         5MM: mm (milli-newton)         0\n"
       "  1.00000000000000000D+03  1.00000000000000000D+03  1.00000000000000000D+00\n"
       "  2.73160000000000025D+02\n    -1\n" +
           changed([](Dataset& d) {
             d.ordinate = "        12    1    0    0 Acceleration         mm/s^2              \n";
             d.denominator = "        13    0    1    0 Force                mN                  \n";
           })},
      {"binary, single, little", binary(true, false, true, "")},
      {"binary, single, big", binary(true, true, true, "")},
      {"binary, double, little", binary(false, false, true, "")},
      {"binary, double, big", binary(false, true, true, "")},
      {"binary, single, uneven", binary(true, false, false, "")},
      {"binary, double, uneven", binary(false, false, false, "")},
      {"binary, a line end before -1", binary(false, false, true, "\n")},
      {"binary, CRLF before -1", binary(false, false, true, "\r\n")},
      {"binary, uneven, single abscissas in double data", changed([&](Dataset& d) {
         d.values = "";
         for (std::size_t i = 0; i < 3; ++i) {
           d.values += bytes_of({uneven[3 * i]}, true, false);
           d.values += bytes_of({uneven[3 * i + 1], uneven[3 * i + 2]}, false, false);
         }
         d.header = binary_header(1, d.values.size());
         d.layout = "         6         3         0  0.00000E+00  0.00000E+00  0.00000E+00\n";
       })},
      {"binary, a wrong number of bytes", changed([&](Dataset& d) {
         d.values = bytes_of(numbers, false, false);
         d.header = binary_header(1, 7);
         d.layout[9] = '6';
       })},
      {"binary, filled up", changed([&](Dataset& d) {
         d.values = bytes_of(numbers, false, false) + std::string(16, '\0');
         d.header = binary_header(1, d.values.size());
         d.layout[9] = '6';
       })},
  };
  for (const auto& [name, text] : variants) {
    INFO(name);
    dynamics::FrequencyResponse frf;
    REQUIRE_NOTHROW(frf = read(text));
    CHECK(frf.quantity == dynamics::Quantity::kAccelerance);
    REQUIRE(frf.entries.size() == 1);
    CHECK(frf.entries[0].response + frf.entries[0].reference == "xx");
    REQUIRE(frf.frequency_hz.size() == 3);
    CHECK((frf.frequency_hz - kLines).norm() < 1e-12);
    const bool single = name.find("single") != std::string::npos;
    CHECK((frf.entries[0].h - kValues).norm() <= (single ? 1e-6 : 1e-15) * kValues.norm());
  }
}

TEST_CASE("broken universal files are refused with their place") {
  CHECK(complaint("    -1\n   151\nmodel\n    -1\n") ==
        "f: 1 datasets, none of them 58: expected a universal file with functions, dataset 58");
  CHECK(complaint(changed([](Dataset& d) { d.values = " 1 2 3 4 5\n"; })) ==
        "f: line 15 (function 1, record 12): -1: expected 6 numbers, as record 7 says, after 5");
  CHECK(complaint(changed([](Dataset& d) {
          d.values = " 1 2 3 4 5\n";
          d.end = "";
        })) ==
        "f: line 14 (function 1, record 12): end of the file: expected 6 numbers, as record 7 says, after 5");
  CHECK(complaint(changed([](Dataset& d) { d.values = " 1 2 3 4 five 6\n"; })) ==
        "f: line 14 (function 1, record 12): five: expected a number");
  CHECK(complaint(changed([](Dataset& d) {
          d.layout[9] = '3';
        })).find("f: line 9 (function 1, record 7): 3: expected an ordinate data type") == 0);
  CHECK(complaint(changed([](Dataset& d) {
          d.layout[19] = '0';
        })).find("f: line 9 (function 1, record 7): 0: expected a number of values above 0") == 0);
  CHECK(complaint(changed([](Dataset& d) {
          d.layout.replace(10, 10, "2000000000");
        })).find("f: line 9 (function 1, record 7): 2000000000: expected a number of values that") == 0);
  CHECK(complaint(changed([](Dataset& d) { d.layout[29] = '2'; })).find("2: expected an abscissa spacing") !=
        std::string::npos);
  CHECK(complaint(changed([](Dataset& d) {
          d.places = "somewhere\n";
        })).find("f: line 8 (function 1, record 6): somewhere: expected a function type") == 0);
  CHECK(complaint(Dataset().text().substr(0, 120)).find("expected record") != std::string::npos);
  CHECK(complaint(changed([](Dataset& d) {
          d.layout = "         5         3         1  1.00000E+00 -5.00000E-01  0.00000E+00\n";
        })).find("0.5 Hz: expected increasing") != std::string::npos);
  const auto binary = [](const std::string& header) {
    return changed([&](Dataset& d) {
      d.header = header;
      d.values = std::string(24, 'a');
    });
  };
  CHECK(complaint(binary("    58b     1     1          11          24     0     0           0           0\n"))
            .find("f: line 2: floating-point format 1: expected 2, IEEE 754") == 0);
  CHECK(complaint(binary("    58b     3     2          11          24     0     0           0           0\n"))
            .find("f: line 2: byte order 3: expected 1") == 0);
  CHECK(complaint(changed([](Dataset& d) {
          d.header = binary_header(1, 24);
          d.values = "abc";
        })).find("(function 1, record 12): 10 bytes: expected 24") != std::string::npos);
  const std::string twice =
      Dataset().text() + changed([](Dataset& d) {
        d.places = "    4         0    0         0 NONE               1   1 NONE               1   2\n";
        d.layout = "         5         3         1  1.00000E+00  6.00000E-01  0.00000E+00\n";
      });
  CHECK(complaint(twice).find("f: line 24 (function 2, record 7): 3 lines from 1 to 2.2 Hz: expected the 3 "
                              "lines of the functions before") == 0);
}

// Files that this project did not write, where they may be used.
TEST_CASE("measured universal files") {
  const std::string folder = std::string(STABLECUT_TESTDATA) + "/../../shared/real/uff/";
  const auto text_of = [&](const char* name) {
    std::ifstream file(folder + name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  if (text_of("non_ascii_header.uff").empty()) {
    WARN("skipped: the measured files are not here");
    return;
  }
  const auto text = read_universal_file({"text", text_of("Sample_UFF58_ascii.uff")});
  const auto binary = read_universal_file({"binary", text_of("Sample_UFF58b_bin.uff")});
  REQUIRE(text.size() == 1);
  REQUIRE(binary.size() == 1);
  REQUIRE(text[0].values.size() == 79292);
  REQUIRE(binary[0].values.size() == 79292);
  // The same numbers, to the six digits of the text.
  CHECK((text[0].values - binary[0].values).cwiseAbs().maxCoeff() < 5e-6);
  CHECK(((text[0].values - binary[0].values).array().abs() <= 1e-5 * binary[0].values.array().abs() + 1e-12)
            .all());
  CHECK(text[0].abscissa == binary[0].abscissa);
  for (const char* name : {"Sample_UFF58_ascii.uff", "Sample_UFF58b_bin.uff"}) {
    CHECK(complaint(text_of(name)) ==
          "f: line 8 (function 1, record 6): function type 1, a time response: expected type 4, a frequency "
          "response");
  }
  const auto sine = read_universal_file({"sine", text_of("binary8byte.uff")});
  REQUIRE(sine.size() == 1);
  double farthest = 0;
  for (Eigen::Index i = 0; i < 250; ++i)
    farthest = std::max(farthest, std::abs(sine[0].values[i] - std::sin(2 * 3.14159265358979 * 5 * 0.01 *
                                                                        static_cast<double>(i))));
  CHECK(farthest < 1e-5);
  const auto h1 = read(text_of("non_ascii_header.uff"));
  CHECK(h1.quantity == dynamics::Quantity::kAccelerance);
  REQUIRE(h1.entries.size() == 1);
  CHECK(h1.entries[0].h.size() == 6);
  CHECK(h1.entries[0].h[5] == Complex(3.75037, 2.93363));
  CHECK(h1.frequency_hz[1] == 0.195313);
}
