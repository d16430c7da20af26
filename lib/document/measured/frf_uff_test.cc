#include "document/measured/frf_uff.h"

#include <catch2/catch.hpp>
#include <complex>

#include "document/measured/universal_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::document;
using namespace stablecut::document::fixtures;
using Complex = std::complex<double>;

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
