#include "document/measured/tap_records.h"

#include <catch2/catch.hpp>
#include <string>

#include "document/measured/reader_fixtures_test.h"
#include "document/measured/tap_column_name.h"
#include "document/text/data_error.h"

using namespace stablecut;
using namespace stablecut::document;

namespace {

constexpr double kG = 9.80665;

TapRecords read(const std::string& text, const TapRecordChoice& choice = {},
                std::vector<Remark>* said = nullptr) {
  std::vector<Remark> remarks;
  Input input;
  input.source = {"taps.csv", text};
  TapRecords records = tap_records(input, "x", choice, remarks);
  if (said) *said = remarks;
  return records;
}

std::string refusal(const std::string& text, const TapRecordChoice& choice = {}) {
  try {
    read(text, choice);
  } catch (const DataError& error) {
    return error.what();
  }
  return "read";
}

TapRecordChoice with_sensitivities(const std::vector<std::string>& texts) {
  TapRecordChoice choice;
  for (const std::string& text : texts) choice.sensitivities.push_back(sensitivity_named(text).value());
  return choice;
}

}  // namespace

TEST_CASE("names of columns of a tap") {
  using Kind = TapColumnKind;
  struct Case {
    const char* field;
    Kind kind;
    const char* direction;
    double to_si;
  };
  for (const Case& c :
       {Case{"Time (s)", Kind::kTime, "", 1}, Case{"t", Kind::kTime, "", 1},
        Case{"time_ms", Kind::kTime, "", 1e-3}, Case{"Hammer [N]", Kind::kForce, "", 1},
        Case{"force_lbf", Kind::kForce, "", 4.4482216152605}, Case{"Fx", Kind::kForce, "x", 1},
        Case{"acc_x (g)", Kind::kResponse, "x", kG}, Case{"-ay", Kind::kResponse, "-y", 1},
        Case{"y [m/s²]", Kind::kResponse, "y", 1}, Case{"AccZ", Kind::kResponse, "z", 1},
        Case{"vx (mm/s)", Kind::kResponse, "x", 1e-3}, Case{"Kraft", Kind::kForce, "", 1},
        Case{"acc_x_m_per_s2", Kind::kResponse, "x", 1}, Case{"x (mV)", Kind::kResponse, "x", 1e-3}}) {
    const auto name = tap_column_name(c.field);
    INFO(c.field);
    REQUIRE(name.has_value());
    CHECK(name->kind == c.kind);
    CHECK(name->direction == c.direction);
    CHECK(name->to_si == Approx(c.to_si).epsilon(1e-15));
  }
  for (const char* field : {"sample", "microphone (Pa)", "Re(Hxx)", "7"}) CHECK_FALSE(tap_column_name(field));
}

TEST_CASE("columns of time, force and responses, in SI") {
  const TapRecords records =
      read("logger 3\ntime (ms);hammer (N);acc y (g);-ax (g)\n0,0;1,5;2;3\n0,5;-1,5;4;-5\n1,0;0;0,1;0\n");
  CHECK(records.responses == std::vector<std::string>{"y", "x"});
  CHECK(records.quantity == dynamics::Quantity::kAccelerance);
  REQUIRE(records.records.size() == 1);
  const taps::Record& record = records.records[0];
  CHECK(record.sample_rate_hz == 2000);
  CHECK(record.force == Eigen::Vector3d(1.5, -1.5, 0));
  CHECK(record.responses[0].isApprox(kG * Eigen::Vector3d(2, 4, 0.1), 1e-15));
  CHECK(record.responses[1].isApprox(-kG * Eigen::Vector3d(3, -5, 0), 1e-15));
}

TEST_CASE("without a header: time, force, responses, and what was assumed is said") {
  std::vector<Remark> said;
  TapRecords records = read("0 1 2\n0.001 3 4\n0.002 5 6\n", {}, &said);
  CHECK(records.responses == std::vector<std::string>{"x"});
  CHECK(records.records[0].sample_rate_hz == 1000);
  REQUIRE(said.size() == 2);
  CHECK(said[0].kind == RemarkKind::kForceUnitMissing);
  CHECK(said[1].kind == RemarkKind::kMotionTaken);
  TapRecordChoice choice;
  choice.sample_rate_hz = 5000;
  choice.unit = frf_unit("um/N");
  records = read("1 2 7\n3 4 8\n2 6 9\n", choice, &said);  // no times
  CHECK(records.records[0].sample_rate_hz == 5000);
  CHECK(records.records[0].force == Eigen::Vector3d(1, 3, 2));
  CHECK(records.responses == std::vector<std::string>{"x", "y"});
  CHECK(records.quantity == dynamics::Quantity::kReceptance);
  CHECK(records.records[0].responses[1].isApprox(1e-6 * Eigen::Vector3d(7, 8, 9), 1e-15));
  REQUIRE(said.size() == 1);
  CHECK(said[0].kind == RemarkKind::kResponsesTakenAs);
}

TEST_CASE("volts by sensitivities") {
  const TapRecords records =
      read("t (s),force (mV),x (V),y (V)\n0,22.5,1,2\n0.1,0,0.5,0\n",
           with_sensitivities({"force=2.25mV/N", "x=100mV/g", "response=0.01 V/(m/s^2)"}));
  CHECK(records.records[0].force.isApprox(Eigen::Vector2d(10, 0), 1e-14));
  CHECK(records.records[0].responses[0].isApprox(Eigen::Vector2d(10 * kG, 5 * kG), 1e-14));
  CHECK(records.records[0].responses[1].isApprox(Eigen::Vector2d(200, 0), 1e-14));
  for (const char* wrong : {"force=2.25", "force=mV/N", "=1V/N", "x=1V/N", "force=1V/g", "x=0V/g", "x=1A/g"})
    CHECK_FALSE(sensitivity_named(wrong));
}

TEST_CASE("what is no record of a tap is refused with its place") {
  const auto starts = [](const std::string& text, const std::string& with) {
    return text.substr(0, with.size()) == with;
  };
  const std::string head = "time (s),force (N),acc_x (g)\n";
  CHECK(starts(refusal("time (s),force (V),acc_x (g)\n0,1,2\n1,2,3\n"),
               "taps.csv: line 1: V: expected a sensitivity"));
  CHECK(starts(refusal(head + "0,1,2\n1,2,3\n", with_sensitivities({"force=1V/N"})),
               "taps.csv: line 1: N: expected volts"));
  CHECK(
      starts(refusal("time (s),acc_x (g)\n0,1\n1,2\n"), "taps.csv: line 1: expected a column of the force"));
  CHECK(
      starts(refusal("time (s),force (N)\n0,1\n1,2\n"), "taps.csv: line 1: expected a column of a response"));
  CHECK(starts(refusal("force (N),acc_x (g)\n0,1\n1,2\n"), "taps.csv: line 1: expected a column of times"));
  CHECK(starts(refusal("time (s),force (N),acc_x (g),temperature (K)\n0,1,2,3\n1,2,3,4\n"),
               "taps.csv: line 1: \"temperature (K)\": expected a time"));
  CHECK(starts(refusal("time (s),force (N),acc (g),acc (g)\n0,1,2,3\n1,2,3,4\n"),
               "taps.csv: line 1: expected the direction"));
  CHECK(starts(refusal("time (s),force (N),ax (g),vy (mm/s)\n0,1,2,3\n1,2,3,4\n"),
               "taps.csv: line 1: mm/s: expected accelerance"));
  CHECK(starts(refusal(head + "0,1,2\n1,2,oops\n"),
               "taps.csv: line 3: \"oops\": expected a number in column 3"));
  CHECK(starts(refusal(head + "0,1,2\n1,2,3\n3,2,3\n4,2,3\n5,1,2\n6,1,2\n7,1,2\n8,1,2\n"),
               "taps.csv: line 2: 3 s: expected times in equal steps"));
  CHECK(starts(refusal(head), "taps.csv: no rows of numbers"));
  CHECK(starts(refusal("0,1\n1,2\n"), "taps.csv: line 1: 2 columns: expected time, force and responses"));
  CHECK(starts(refusal("time (s),t (ms),force (N),acc_x (g)\n0,1,2,3\n"),
               "taps.csv: line 1: \"t (ms)\": expected one column of times"));
  CHECK(starts(refusal("time (s),force (N),fx (N),acc_x (g)\n0,1,2,3\n"),
               "taps.csv: line 1: \"fx (N)\": expected one column of force"));
  CHECK(starts(refusal("time (s),force (N),ax (g),-ax (g)\n0,1,2,3\n1,2,3,4\n"),
               "taps.csv: line 2: x: expected one response in each direction"));
  CHECK(starts(refusal("time (s),force (furlong),acc_x (g)\n0,1,2\n1,2,3\n"),
               "taps.csv: line 1: furlong: expected a unit of force"));
  CHECK(starts(refusal("time (s),force (N),acc_x (furlong)\n0,1,2\n1,2,3\n"),
               "taps.csv: line 1: furlong: expected a unit of a motion"));
}

TEST_CASE("rates from times as they are written") {
  const Source source{"taps.csv", ""};
  Eigen::VectorXd times(1000);
  for (const double digits : {1e-7, 1e-5}) {
    for (Eigen::Index i = 0; i < 1000; ++i)
      times[i] = digits * std::round(static_cast<double>(i) / 51200 / digits);
    CHECK(sample_rate_of(times, source, "") == 51200);
  }
  times = Eigen::VectorXd::LinSpaced(1000, 0, 999) / 1000.25;
  CHECK(sample_rate_of(times, source, "") == Approx(1000.25).epsilon(1e-12));
}

TEST_CASE("a force along another direction, and a channel that is turned") {
  std::vector<Remark> said;
  const TapRecords records = read("t (s),-fy (N),acc_x (m/s^2)\n0,1,2\n1,2,3\n", {}, &said);
  CHECK(records.records[0].force == Eigen::Vector2d(-1, -2));
  REQUIRE(said.size() == 1);
  CHECK(said[0].kind == RemarkKind::kForceOverruled);
}
