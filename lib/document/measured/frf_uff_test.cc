#include "document/measured/frf_uff.h"

#include <catch2/catch.hpp>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>

#include "document/measured/frf_uff_writer.h"
#include "document/measured/universal_file.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;
using Complex = std::complex<double>;

namespace {

dynamics::FrequencyResponse read(const std::string& text, const FrfChoice& choice = {}) {
  std::vector<Remark> remarks;
  return frf_from_universal_file({"f", text}, choice, remarks);
}

std::vector<Remark> remarks_on(const std::string& text, const FrfChoice& choice = {}) {
  std::vector<Remark> remarks;
  frf_from_universal_file({"f", text}, choice, remarks);
  return remarks;
}

Remark only_remark(const std::string& text, const FrfChoice& choice = {}) {
  const std::vector<Remark> remarks = remarks_on(text, choice);
  REQUIRE(remarks.size() == 1);
  return remarks[0];
}

std::string complaint(const std::string& text, const FrfChoice& choice = {}) {
  try {
    read(text, choice);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

// A dataset 58 as the definition of the format asks for it; each record can be another.
struct Dataset {
  std::string header = "    58\n";
  std::string id = "NONE\nNONE\nNONE\nNONE\nNONE\n";
  std::string places = "    4         0    0         0 NONE               1   1 NONE               1   1\n";
  std::string layout = "         5         3         1  1.00000E+00  5.00000E-01  0.00000E+00\n";
  std::string abscissa = "        18    0    0    0 Frequency            Hz                  \n";
  std::string ordinate = "        12    1    0    0 Acceleration         m/s^2               \n";
  std::string denominator = "        13    0    1    0 Force                N                   \n";
  std::string z = "         0    0    0    0 NONE                 NONE                \n";
  std::string values = "  1.00000E+00  2.00000E+00  3.00000E+00 -4.00000E+00  5.00000E-03  6.00000E+03\n";
  std::string end = "    -1\n";

  std::string text() const {
    return "    -1\n" + header + id + places + layout + abscissa + ordinate + denominator + z + values + end;
  }
};

std::string changed(const std::function<void(Dataset&)>& change) {
  Dataset dataset;
  change(dataset);
  return dataset.text();
}

std::string bytes_of(const std::vector<double>& values, bool single, bool big) {
  std::string bytes;
  for (const double value : values) {
    char raw[8];
    const auto f = static_cast<float>(value);
    const std::size_t size = single ? 4 : 8;
    std::copy_n(single ? reinterpret_cast<const char*>(&f) : reinterpret_cast<const char*>(&value), size,
                raw);
    if (big) std::reverse(raw, raw + size);
    bytes.append(raw, size);
  }
  return bytes;
}

std::string binary_header(int order, std::size_t bytes) {
  char line[100];
  std::snprintf(line, sizeof line, "%6db%6d%6d%12d%12zu%6d%6d%12d%12d\n", 58, order, 2, 11, bytes, 0, 0, 0,
                0);
  return line;
}

const Eigen::Vector3cd kValues(Complex(1, 2), Complex(3, -4), Complex(5e-3, 6e3));
const Eigen::Vector3d kLines(1, 1.5, 2);

std::string crlf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

}  // namespace

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

TEST_CASE("functions become a matrix by node and direction, signs taken off") {
  const auto function = [](int response_node, int response, int reference_node, int reference) {
    return changed([&](Dataset& d) {
      char line[90];
      std::snprintf(line, sizeof line, "    4         0    0         0 NONE      %10d%4d NONE      %10d%4d\n",
                    response_node, response, reference_node, reference);
      d.places = line;
    });
  };
  const auto matrix =
      read(function(7, 1, 7, 1) + function(7, -2, 7, 1) + function(7, 1, 7, 2) + function(7, 2, 7, -3));
  REQUIRE(matrix.entries.size() == 4);
  CHECK(matrix.find("x", "x")->h[0] == kValues[0]);
  CHECK(matrix.find("y", "x")->h[0] == -kValues[0]);
  CHECK(matrix.find("x", "y")->h[0] == kValues[0]);
  CHECK(matrix.find("y", "z")->h[0] == -kValues[0]);
  // One place for the sensor, one for the hammer: the same, said so.
  CHECK(read(function(1, 1, 2, 1)).find("x", "x") != nullptr);
  CHECK(only_remark(function(1, 1, 2, 1)).kind == RemarkKind::kTwoNodes);
  CHECK(only_remark(function(1, 1, 2, 1)).numbers == std::vector<double>{1, 2});
  const std::string several = function(1, 1, 1, 1) + function(1, 1, 2, 1) + function(2, 1, 1, 1);
  CHECK(read(several).find("x@1", "x@2") != nullptr);
  CHECK(only_remark(several).kind == RemarkKind::kSeveralNodes);
  CHECK(only_remark(several).numbers == std::vector<double>{2, 2, 1});
  CHECK(read(several, {.node = 1}).entries.size() == 1);
  CHECK(complaint(several, {.node = 9}).find("f: node 9: expected a node at which both") == 0);
  CHECK(complaint(function(1, 1, 1, 1) + function(1, -1, 1, -1))
            .find("f: line 23 (function 2, record 6): xx: measured in function 1 too") == 0);
  CHECK(read(function(1, 1, 1, 1) + function(1, -1, 1, 1), {.functions = {2}}).entries[0].h[0] ==
        -kValues[0]);
  CHECK(complaint(function(1, 1, 1, 1), {.functions = {2}}) ==
        "f: function 2: expected one of the file's 1 functions");
  CHECK(only_remark(function(1, 0, 1, 0)).kind == RemarkKind::kDirectionMissing);
}

TEST_CASE("what a function means") {
  const auto with_axes = [](const std::string& ordinate, const std::string& denominator) {
    return changed([&](Dataset& d) {
      d.ordinate = ordinate + "\n";
      d.denominator = denominator + "\n";
    });
  };
  const std::string force = "        13    0    1    0 Force                N                   ";
  const auto displacement =
      read(with_axes("         8    1    0    0 Displacement         um                  ", force));
  CHECK(displacement.quantity == dynamics::Quantity::kReceptance);
  CHECK(std::abs(displacement.entries[0].h[0] - 1e-6 * kValues[0]) < 1e-20);
  CHECK(read(with_axes("        11    1    0    0 Velocity             m/s                 ", force))
            .quantity == dynamics::Quantity::kMobility);
  const std::string in_g =
      with_axes("        12    1    0    0 Acceleration         g                   ", force);
  CHECK(std::abs(read(in_g).entries[0].h[0] - 9.80665 * kValues[0]) < 1e-12);
  const std::string units =
      "    -1\n   164\n         7IN: in, lbf                    0\n"
      "  3.93700787401574790D+01  2.24808943099710480D-01  1.00000000000000000D+00\n"
      "  4.59670000000000016D+02\n    -1\n";
  const std::string unlabelled =
      with_axes("        12    1    0    0 NONE                 NONE                ",
                "        13    0    1    0 NONE                 NONE                ");
  const double inch_per_pound = 0.0254 / 4.4482216152605;
  CHECK(std::abs(read(units + unlabelled).entries[0].h[0] / kValues[0] - inch_per_pound) < 1e-9);
  CHECK(only_remark(unlabelled).kind == RemarkKind::kUnitMissing);
  // A label in g is believed beside dataset 164; another that contradicts it is not. Both are said.
  CHECK(std::abs(read(units + in_g).entries[0].h[0] - 9.80665 * kValues[0]) < 1e-12);
  CHECK(only_remark(units + in_g).kind == RemarkKind::kUnitInG);
  CHECK(std::abs(read(units + Dataset().text()).entries[0].h[0] / kValues[0] - inch_per_pound) < 1e-9);
  CHECK(only_remark(units + Dataset().text()).kind == RemarkKind::kUnitContradicted);
  CHECK(read(units + in_g, {.unit = frf_unit("m/N")}).entries[0].h[0] == kValues[0]);
  CHECK(read(Dataset().text(), {.quantity = dynamics::Quantity::kMobility}).quantity ==
        dynamics::Quantity::kMobility);
  // Behind the functions it counts too; a label that is not known is named.
  CHECK(read(unlabelled + units).entries[0].h == read(units + unlabelled).entries[0].h);
  const std::string volts =
      with_axes("        12    1    0    0 Acceleration         V                   ", force);
  const Remark unknown = only_remark(volts);
  CHECK(unknown.kind == RemarkKind::kUnitUnknownTakenAsSi);
  CHECK(unknown.file == "f");
  CHECK(unknown.place.text() == "line 11 (function 1, record 9)");
  CHECK(unknown.written == "V over N");
  CHECK(only_remark(units + volts).kind == RemarkKind::kUnitUnknown);
  // Of functions alike it is said once.
  CHECK(remarks_on(units + volts + changed([](Dataset& d) {
                     d.places.replace(54, 1, "2");
                     d.ordinate.replace(47, 5, "V    ");
                   }))
            .size() == 1);
  const std::string nothing =
      with_axes("         0    0    0    0 NONE                 NONE                ",
                "         0    0    0    0 NONE                 NONE                ");
  CHECK(complaint(nothing).find(
            "f: line 11 (function 1, record 9): data type 0: does not say what the response is") == 0);
  CHECK(read(nothing, {.quantity = dynamics::Quantity::kReceptance}).entries.size() == 1);
  // m/s^2, said to be a mobility.
  const auto overruled = remarks_on(Dataset().text(), {.quantity = dynamics::Quantity::kMobility});
  REQUIRE(overruled.size() == 2);
  CHECK(overruled[0].kind == RemarkKind::kQuantityOverruled);
  CHECK(overruled[1].kind == RemarkKind::kUnitUnknownTakenAsSi);
  const std::string velocity =
      with_axes("        12    1    0    0 Acceleration         m/s                 ", force);
  const auto other_quantity = remarks_on(velocity);
  REQUIRE(other_quantity.size() == 2);
  CHECK(other_quantity[0].kind == RemarkKind::kUnitOfOtherQuantity);
  CHECK(other_quantity[1].kind == RemarkKind::kUnitUnknownTakenAsSi);
  const std::string of_turns = changed([](Dataset& d) {
    d.abscissa = "        18    0    0    0 Frequency            turns               \n";
  });
  CHECK(only_remark(of_turns).kind == RemarkKind::kFrequencyUnitUnknown);
  CHECK(only_remark(of_turns).place.record == 8);
}

TEST_CASE("lines and units that differ by their digits only are the same") {
  const auto second = [](const char* first, const char* step) {
    return changed([&](Dataset& d) {
      d.places = "    4         0    0         0 NONE               1   1 NONE               1   2\n";
      d.layout = std::string("         5         3         1  ") + first + "  " + step + "  0.00000E+00\n";
    });
  };
  CHECK(read(Dataset().text() + second("1.00001E+00", "5.00000E-01")).entries.size() == 2);
  CHECK(complaint(Dataset().text() + second("1.00010E+00", "5.00000E-01"))
            .find("expected the 3 lines of the functions before") != std::string::npos);
  // mm/s^2 over N beside a dataset 164 of so many units a metre.
  const auto beside = [](const char* per_metre) {
    return std::string("    -1\n   164\n         5MM                             0\n  ") + per_metre +
           "  1.00000000000000000D+00  1.00000000000000000D+00\n  2.73160000000000025D+02\n    -1\n" +
           changed([](Dataset& d) {
             d.ordinate = "        12    1    0    0 Acceleration         mm/s^2              \n";
           });
  };
  CHECK(remarks_on(beside("1.00010000000000000D+03")).empty());
  CHECK(only_remark(beside("1.01000000000000000D+03")).kind == RemarkKind::kUnitContradicted);
}

TEST_CASE("what is no frequency response is refused with function, record and line") {
  CHECK(complaint(changed([](Dataset& d) { d.places[4] = '1'; })) ==
        "f: line 8 (function 1, record 6): function type 1, a time response: expected type 4, a frequency "
        "response");
  CHECK(complaint(changed([](Dataset& d) {
          d.places.replace(3, 2, "12");
        })).find("function type 12, a spectrum") != std::string::npos);
  CHECK(complaint(changed([](Dataset& d) {
          d.places[4] = '6';
        })).find("a coherence: expected frequency responses too") != std::string::npos);
  CHECK(complaint(changed([](Dataset& d) {
          d.abscissa.replace(8, 2, "17");
        })).find("f: line 10 (function 1, record 8): data type 17") == 0);
  CHECK(complaint(changed([](Dataset& d) {
          d.layout[9] = '2';
          d.values = " 1 2 3\n";
        })) ==
        "f: line 9 (function 1, record 7): real numbers: expected complex ones, ordinate data type 5 or 6");
  CHECK(complaint(changed([](Dataset& d) {
          d.denominator.replace(8, 2, "12");
        })).find("(function 1, record 10): data type 12") != std::string::npos);
  CHECK(complaint(changed([](Dataset& d) {
          d.ordinate.replace(8, 2, "15");
        })).find("(function 1, record 9): data type 15") != std::string::npos);
  CHECK(complaint(changed([](Dataset& d) {
          d.places[54] = '4';
        })).find("response direction 4: expected a translation") != std::string::npos);
  // Beside a frequency response it is left out, and said.
  const std::string both = changed([](Dataset& d) { d.places[4] = '1'; }) + Dataset().text();
  CHECK(read(both).entries.size() == 1);
  const Remark left_out = only_remark(both);
  CHECK(left_out.kind == RemarkKind::kNoFrequencyResponse);
  CHECK(left_out.place.line == 8);
  CHECK(left_out.place.function == 1);
  CHECK(left_out.place.record == 6);
  CHECK(left_out.numbers == std::vector<double>{1});
}

TEST_CASE("coherences go to their entries") {
  const std::string coherence = changed([](Dataset& d) {
    d.places[4] = '6';
    d.layout[9] = '2';
    d.ordinate = d.denominator = "         0    0    0    0 NONE                 NONE                \n";
    d.values = "  9.00000E-01  1.00000E+00  5.00000E-01\n";
  });
  const auto frf = read(Dataset().text() + coherence, {.averages = 4.0});
  REQUIRE(frf.entries.size() == 1);
  REQUIRE(frf.entries[0].coherence.size() == 3);
  CHECK(frf.entries[0].coherence[2] == 0.5);
  CHECK(frf.entries[0].averages == 4.0);
}

TEST_CASE("coherences in percent") {
  const std::string coherence = changed([](Dataset& d) {
    d.places[4] = '6';
    d.layout[9] = '2';
    d.values = "  9.00000E+01  1.00000E+02  5.00000E+01\n";
  });
  CHECK(read(Dataset().text() + coherence).entries[0].coherence == Eigen::Vector3d(0.9, 1, 0.5));
  const Remark percent = only_remark(Dataset().text() + coherence);
  CHECK(percent.kind == RemarkKind::kCoherenceTakenAsPercent);
  CHECK(percent.place.function == 2);
  CHECK(percent.numbers == std::vector<double>{100});
}

TEST_CASE("what a division by zero leaves at 0 Hz is no error in a universal file") {
  const auto with_nan = [](const char* first) {
    return changed([&](Dataset& d) {
      d.layout = std::string("         5         3         1  ") + first + "  5.00000E-01  0.00000E+00\n";
      d.values = " NaN -Infinity 3 4 5 6\n";
    });
  };
  CHECK(read(with_nan("0.00000E+00")).entries[0].h[0] == Complex(0, 0));
  CHECK(complaint(with_nan("1.00000E+00"))
            .find("(function 1, record 12): line at 1 Hz: expected a finite number") != std::string::npos);
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

TEST_CASE("what is written reads back") {
  dynamics::FrequencyResponse frf;
  frf.quantity = dynamics::Quantity::kMobility;
  for (const char* response : {"x", "y"}) {
    for (const char* reference : {"x", "y"}) {
      dynamics::FrequencyResponseEntry entry;
      entry.response = response;
      entry.reference = reference;
      frf.entries.push_back(entry);
    }
  }
  const auto fill = [&](const Eigen::VectorXd& lines) {
    frf.frequency_hz = lines;
    double seed = 0.1;
    for (auto& entry : frf.entries) {
      entry.h.resize(lines.size());
      for (auto& value : entry.h) {
        const double a = seed = std::fmod(seed * 997.3 + 0.7, 1.0);
        const double b = seed = std::fmod(seed * 997.3 + 0.7, 1.0);
        value = Complex((a - 0.5) * std::pow(10, 20 * b - 15), (b - 0.5) * 1e-7);
      }
    }
  };
  for (const Eigen::VectorXd& lines : {Eigen::VectorXd(Eigen::VectorXd::LinSpaced(401, 2, 102)),
                                       Eigen::VectorXd(Eigen::VectorXd::LinSpaced(333, 1, 1000)),
                                       Eigen::VectorXd(Eigen::VectorXd::LinSpaced(57, 0, 7).array().exp()),
                                       Eigen::VectorXd(Eigen::VectorXd::Constant(1, 50))}) {
    fill(lines);
    // Binary: the same to the last bit.
    const std::string binary = frf_to_universal_file(frf, UniversalForm::kBinary);
    const dynamics::FrequencyResponse same = read(binary);
    CHECK(remarks_on(binary).empty());
    CHECK(same.quantity == frf.quantity);
    CHECK(same.frequency_hz == frf.frequency_hz);
    for (const auto& entry : frf.entries) CHECK(same.find(entry.response, entry.reference)->h == entry.h);
    CHECK(frf_to_universal_file(same, UniversalForm::kBinary) == binary);
    // Text: to the thirteen digits that the format has, and from then on the same text.
    const std::string text = frf_to_universal_file(frf, UniversalForm::kText);
    const dynamics::FrequencyResponse near = read(text);
    CHECK(
        ((near.frequency_hz - frf.frequency_hz).array().abs() <= 1.1e-9 * frf.frequency_hz.maxCoeff()).all());
    for (const auto& entry : frf.entries) {
      const auto& other = near.find(entry.response, entry.reference)->h;
      CHECK(((other - entry.h).array().real().abs() <= 5.1e-13 * entry.h.array().real().abs()).all());
      CHECK(((other - entry.h).array().imag().abs() <= 5.1e-13 * entry.h.array().imag().abs()).all());
    }
    CHECK(frf_to_universal_file(near, UniversalForm::kText) == text);
    for (std::size_t from = 0; from < text.size();) {
      const auto end = text.find('\n', from);
      CHECK(end - from <= 80);
      from = end + 1;
    }
  }
  frf.entries[0].response = "slope_x";
  CHECK_THROWS_WITH(frf_to_universal_file(frf, UniversalForm::kText), Catch::Contains("slope_x"));
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
