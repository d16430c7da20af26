#include "document/measured/frf_columns.h"

#include <catch2/catch.hpp>
#include <complex>

#include "document/measured/reader_fixtures_test.h"

using namespace stablecut;
using namespace stablecut::document;
using namespace stablecut::document::fixtures;
using Complex = std::complex<double>;

namespace {

dynamics::FrequencyResponse read(const std::string& text, const FrfChoice& choice = {}) {
  return read_by(frf_from_columns, text, choice);
}
Remark only_remark(const std::string& text, const FrfChoice& choice = {}) {
  return only_remark_by(frf_from_columns, text, choice);
}
std::string complaint(const std::string& text, const FrfChoice& choice = {}) {
  return complaint_by(frf_from_columns, text, choice);
}

}  // namespace

TEST_CASE("three columns in whatever dress") {
  for (const char* text : {
           "1.5,2,3\n2.5,4,5\n",
           "1.5, 2, 3\r\n2.5, 4, 5\r\n",
           "1,5;2;3\n2,5;4;5\n",
           "1,5 2,0 3,0\n2,5 4,0 5,0\n",
           "1.5\t2\t3\n2.5\t4\t5",
           "  1.5   2 3 \n  2.5   4 5 \n",
           "1.5|2|3\n2.5|4|5\n",
           "1.5,2,3,\n2.5,4,5,\n",
           "# a tap\n% of\n! today\n// , ; \n\n1.5 2 3\n2.5 4 5\n# end\n",
           "f,Re,Im\n1.5,2,3\n2.5,4,5\n",
           "Frequency (Hz),Real (m/N),Imag (m/N)\n1.5,2,3\n2.5,4,5\n",
           "Freq[Hz];Re[m/N];Im[m/N]\n1,5;2;3\n2,5;4;5\n",
           "f_khz,xx_re,xx_im\n0.0015,2,3\n0.0025,4,5\n",
           "X [kHz],Real,Imaginary\n0.0015,2,3\n0.0025,4,5\n",
           "Frequency,Real,Imag\nHz,mm/N,mm/N\n1.5,2000,3000\n2.5,4000,5000\n",
           "Frequency,Real um/N,Imag um/N\n1.5,2e6,3e6\n2.5,4e6,5e6\n",
           "Analyser 3000\nDate: 2026-11-23, 12:00\nFrequency (Hz),Imag,Real\n1.5,3,2\n2.5,5,4\n",
           "Real,Imag,Frequency\n2,3,1.5\n4,5,2.5\n",
           "1.5 2 3 m/N\n2.5 4 5\n",
           "1.5 2 3 m / N\n2.5 4 5\n",
           "1.5\t2000\t3000\t[mm/N]\n2.5\t4000\t5000\n",
           "Frequency Real Imaginary m/N\n1.5 2 3\n2.5 4 5\n",
           "1.5 3 2 m/N Imag Real\n2.5 5 4\n",
           "1.5\t3000\t2000\t[mm/N]\tImag\tReal\n2.5\t5000\t4000\n",
           "1.5 3 2 Imag Real m / N\n2.5 5 4\n",
           "1.5 2 3 m/N Real Imag\n2.5 4 5\n",
           "1.5 3 2 Imag Real\n2.5 5 4\n",
           "mm/N Imag Real\n1.5 3000 2000\n2.5 5000 4000\n",
           "Frequency Imag Real m/N\n1.5 3 2\n2.5 5 4\n",
           "\"Frequency\",\"Real\",\"Imag\"\n\"1.5\",\"2\",\"3\"\n\"2.5\",\"4\",\"5\"\n",
       }) {
    INFO(text);
    const auto frf = read(text);
    CHECK(frf.quantity == dynamics::Quantity::kReceptance);
    REQUIRE(frf.entries.size() == 1);
    CHECK(frf.entries[0].response + frf.entries[0].reference == "xx");
    REQUIRE(frf.frequency_hz.size() == 2);
    CHECK(frf.frequency_hz[1] == Approx(2.5).epsilon(1e-14));
    CHECK(std::abs(frf.entries[0].h[0] - Complex(2, 3)) < 1e-14);
    CHECK(std::abs(frf.entries[0].h[1] - Complex(4, 5)) < 1e-14);
  }
}

TEST_CASE("units and quantities") {
  CHECK(read("Hz,Re (g/N),Im (g/N)\n1,1,0\n").quantity == dynamics::Quantity::kAccelerance);
  CHECK(read("Hz,Re (g/N),Im (g/N)\n1,1,0\n").entries[0].h[0].real() == Approx(9.80665));
  CHECK(read("Hz,Re [(m/s^2)/N],Im [(m/s^2)/N]\n1,1,0\n").quantity == dynamics::Quantity::kAccelerance);
  CHECK(read("1 2 3 (m/s)/N\n").quantity == dynamics::Quantity::kMobility);
  CHECK(read("1 2 3\n", {.quantity = dynamics::Quantity::kMobility}).quantity ==
        dynamics::Quantity::kMobility);
  CHECK(read("1 2 3\n", {.unit = frf_unit("um/N")}).entries[0].h[0] == Complex(2e-6, 3e-6));
  const Remark overruled =
      only_remark("Hz,Re (g/N),Im (g/N)\n1,1,0\n", {.quantity = dynamics::Quantity::kMobility});
  CHECK(overruled.kind == RemarkKind::kUnitOverruled);
  CHECK(overruled.place.line == 1);
  CHECK(complaint("1 2 3\n", {.form = FrfForm::kCutPro})
            .find("f: line 1: expected a unit at the end of the first line") == 0);
  CHECK(read("1 3 2 mm/N Imag Real\n", {.form = FrfForm::kCutPro}).entries[0].h[0] == Complex(2e-3, 3e-3));
  CHECK(complaint("1 2 3 m/N Imag Imag\n2 3 4\n").find("f: line 1: m/N Imag Imag: expected a unit") == 0);
  CHECK(complaint("1 2 3 m/N Imag\n2 3 4\n").find("f: line 1: m/N Imag: expected a unit") == 0);
  CHECK(complaint("Hz,Re (V/V),Im (V/V)\n1,1,0\n").find("f: line 1: V/V: expected") == 0);
  CHECK(complaint("f (s),Re,Im\n1,1,0\n").find("f: line 1: \"f (s)\": a time: expected frequencies") == 0);
}

TEST_CASE("magnitude and phase, coherence, several pairs") {
  const auto polar = read("f,Magnitude (um/N),Phase (deg)\n1,2,90\n");
  CHECK(std::abs(polar.entries[0].h[0] - Complex(0, 2e-6)) < 1e-20);
  CHECK(std::abs(read("f,Amplitude [dB],Phase [rad]\n1,20,0\n").entries[0].h[0] - 10.0) < 1e-12);
  // A phase without a unit, by its size.
  CHECK(std::abs(read("f,mag,phase\n1,1,3.14159265\n").entries[0].h[0] + 1.0) < 1e-8);
  CHECK(std::abs(read("f,mag,phase\n1,1,180\n").entries[0].h[0] + 1.0) < 1e-12);
  const Remark degrees = only_remark("f,Mag(Hyx),Phase(Hyx)\n1,1,180\n2,1,-270\n");
  CHECK(degrees.kind == RemarkKind::kPhaseTakenAsDegrees);
  CHECK(degrees.entry == "yx");
  CHECK(degrees.numbers == std::vector<double>{270});
  CHECK(only_remark("f,mag,phase\n1,1,-3\n").kind == RemarkKind::kPhaseTakenAsRadians);
  CHECK(only_remark("f,mag,phase\n1,1,-3.142\n").kind == RemarkKind::kPhaseTakenAsRadians);
  CHECK(only_remark("f,mag,phase\n1,1,3.2\n").kind == RemarkKind::kPhaseTakenAsDegrees);
  const auto with_coherence = read("f,Re,Im,Coherence\n1,2,3,0.5\n2,3,4,1\n", {.averages = 5.0});
  REQUIRE(with_coherence.entries[0].coherence.size() == 2);
  CHECK(with_coherence.entries[0].coherence[0] == 0.5);
  CHECK(with_coherence.entries[0].averages == 5.0);
  const auto both = read("f_hz,Hxy (imag),Hxy (real),yy_re,yy_im\n1,2,3,4,5\n");
  REQUIRE(both.entries.size() == 2);
  CHECK(both.find("x", "y")->h[0] == Complex(3, 2));
  CHECK(both.find("y", "y")->h[0] == Complex(4, 5));
  const auto repeated = read("f,Re(Hxx),Im(Hxx),f,Re(H_yx),Im(H_yx)\n1,2,3,1,4,5\n");
  CHECK(repeated.find("y", "x")->h[0] == Complex(4, 5));
  CHECK(complaint("f,Re(Hxx),Im(Hxx),f,Re(Hyx),Im(Hyx)\n1,2,3,2,4,5\n") ==
        "f: line 2: 2: expected the frequency of column 1");
  CHECK(read("f,Re x/-y,Im x/-y\n1,2,3\n").find("x", "y")->h[0] == Complex(-2, -3));
  const auto quotients = read("f,Real(X/FX),Imag(X/FX),Real(Y/FX),Imag(Y/FX)\n1,2,3,4,5\n");
  CHECK(quotients.find("x", "x")->h[0] == Complex(2, 3));
  CHECK(quotients.find("y", "x")->h[0] == Complex(4, 5));
  CHECK(read("f,Re x/fy (um/N),Im x/fy (um/N)\n1,2,3\n").find("x", "y")->h[0] == Complex(2e-6, 3e-6));
  const auto nine = read("1,2,3,4,5,6,7,8,9\n");
  CHECK(nine.find("y", "x")->h[0] == Complex(6, 7));
}

TEST_CASE("what a division by zero leaves at 0 Hz is no error") {
  CHECK(read("0,NaN,-inf\n1,2,3\n").entries[0].h[0] == Complex(0, 0));
  CHECK(complaint("0,1,1\n1,nan,3\n") == "f: line 2: \"nan\": expected a real part in column 2");
}

TEST_CASE("a bad line is named") {
  CHECK(complaint("") == "f: empty input: expected columns of numbers");
  CHECK(complaint("1,2,3\n2,x,3\n") == "f: line 2: \"x\": expected a real part in column 2");
  CHECK(complaint("1,x,3\n2,2,3\n") == "f: line 1: \"x\": expected a real part in column 2");
  CHECK(complaint("1,2,3,4,5,6,7,x,9\n1,2,3,4,5,6,7,8,9\n") ==
        "f: line 1: \"x\": expected a number in column 8");
  CHECK(complaint("1,2,3\n2,nan,3\n") == "f: line 2: \"nan\": expected a real part in column 2");
  CHECK(complaint("1,2,3\n1,2,3\n").find("f: line 2: 1: expected increasing") == 0);
  CHECK(complaint("-1,2,3\n1,2,3\n").find("f: line 1: -1: expected increasing") == 0);
  CHECK(complaint("1,2,3\n2,2\n") == "f: line 2: 2 columns: expected 3 as in the lines before");
  CHECK(complaint("1,2\n").find("f: line 1: 2 columns: expected 3 columns") == 0);
  CHECK(complaint("1,2,3,4,5\n").ends_with("that names them, as f_hz,xx_re,xx_im,yy_re,yy_im"));
  CHECK(complaint("f,a,b\n").find("f: line 1: expected numbers below the header") == 0);
  CHECK(complaint("f,Re(Hxx),Im(Hxy)\n1,2,3\n")
            .find("f: line 1: xx: expected a column of the real and one of") == 0);
  CHECK(complaint("f,Magnitude,b\n1,2,3\n")
            .find("f: line 1: xx: expected a column of the magnitude and one of") == 0);
  CHECK(
      complaint("f,TipX_Re,TipX_Im,TipY_Re,TipY_Im\n1,2,3,4,5\n") ==
      "f: line 1: \"TipX_Re\", \"TipY_Re\": both are xx: expected names with the directions of response and "
      "force, as xx_re and yy_re");
  CHECK(complaint("f,Re,Im,Coh\n1,2,3,1.5\n") == "f: line 2: 1.5: expected a coherence from 0 to 1");
}

TEST_CASE("names that tell the frequency alone") {
  // The other columns count as without names; a coherence by itself is no entry.
  const auto frf = read("f_khz,a,coherence\n0.001,2,3\n");
  CHECK(frf.frequency_hz[0] == 1);
  CHECK(frf.entries.at(0).h[0] == Complex(2, 3));
  CHECK(frf.entries[0].coherence.size() == 0);
}

TEST_CASE("what would be a guess is refused") {
  // Row names without a name, and decimal commas between commas.
  CHECK(complaint("Frequency Real Imag\n1 5 2 3\n2 6 2 3\n") ==
        "f: line 1: 3 names: expected one for each of 4 columns");
  CHECK(complaint("Frequency,Real,Imag\n5,000,-0,1,0,2\n")
            .find("f: line 1: 3 names: expected one for each of 6 columns") == 0);
  // Thousands separators.
  CHECK(complaint("1,000\t1.2e-07\t1\n1,001\t1.2e-07\t1\n").find("expected one decimal mark in the file") !=
        std::string::npos);
  CHECK(complaint("\"1,000\",1.2e-07,1\n").find("expected one decimal mark in the file") !=
        std::string::npos);
  CHECK(complaint("1.000;1,2e-07;1\n").find("f: line 1: 1,2e-07: expected one decimal mark") == 0);
  // Names that tell nothing, also of time records.
  CHECK(complaint("Frecuencia (Hz),Magnitud (m/N),Fase (deg)\n1,2,3\n").find("f: line 1: ") == 0);
  CHECK(complaint("Time (s),Force (N),Acceleration (m/s^2)\n0,2,3\n")
            .find("f: line 1: \"Time (s)\": a time: expected frequencies") == 0);
  // Three numbers and a text that is no unit.
  CHECK(complaint("5 2 3 furlongs/N\n6 2 3\n") ==
        "f: line 1: furlongs/N: expected a unit behind the numbers, as m/N, or nothing");
  CHECK(complaint("f,Magnitude,Phase (deg)\n1,-152,3\n")
            .find("f: xx: magnitude -152: expected none below 0 (is it in dB?)") == 0);
  CHECK(complaint("f,Magnitude,Phase (mrad)\n1,2,3\n") == "f: line 1: mrad: expected a phase in deg or rad");
  CHECK(complaint("f,Re (um/N),Im (m/N)\n1,2,3\n")
            .find("f: line 1: m/N: expected one unit for both parts of xx") == 0);
  CHECK(complaint("f,Re(Hxx) [um/N],Im(Hxx) [um/N],Re(Hyy),Im(Hyy)\n1,2,3,4,5\n")
            .find("f: line 1: units: expected them for all entries") == 0);
}

TEST_CASE("decibels of a unit, units in names, names in German") {
  const auto is = [](const dynamics::FrequencyResponse& frf, Complex value) {
    return std::abs(frf.entries[0].h[0] - value) < 1e-12 * std::abs(value);
  };
  CHECK(is(read("f,Magnitude (dB re 1 m/N),Phase (deg)\n1,-120,90\n"), Complex(0, 1e-6)));
  CHECK(is(read("f,Magnitude (dB um/N),Phase (deg)\n1,20,0\n"), 1e-5));
  CHECK(is(read("f_hz,re_um_per_n,im_um_per_n\n1,2,3\n"), Complex(2e-6, 3e-6)));
  CHECK(read("f_hz,re_m_per_s2_per_n,im_m_per_s2_per_n\n1,2,3\n").quantity ==
        dynamics::Quantity::kAccelerance);
  CHECK(is(read("f,Magnitude,Phase\nHz,dB,deg\n1,20,0\n"), 10));
  CHECK(is(read("Frequenz;Imagin\xC3\xA4rteil;Realteil\n1;3;2\n"), Complex(2, 3)));
}
