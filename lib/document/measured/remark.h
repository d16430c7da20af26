// What the user should know about how a file was read: facts here, sentences by remark_text().
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "document/text/data_error.h"

namespace stablecut::document {

/// Where in a file. Universal files have functions and records, other files lines only.
struct FilePlace {
  long line = 0;     ///< 1-based; 0: the whole file
  int function = 0;  ///< 1-based; 0: none
  int record = 0;    ///< of the function

  /// `line 6 (function 1, record 5)`, `line 6`; empty for the whole file.
  std::string text() const;
};

/// The sentences are in remark.cc, a row each. In brackets what Remark::numbers holds.
enum class RemarkKind {
  // A function of a universal file is left out. `written` is what stands there.
  kNoFrequencyResponse,  ///< its function type is another [type]
  kNoResponseOverForce,  ///< its function type is general, and it is no response over a force either [type]
  kAbscissaNoFrequency,  ///< the abscissa's data type is another [data type]
  kAbscissaUnitNoFrequency,  ///< the abscissa's unit is another
  kRealNumbers,              ///< its numbers are not complex
  kRotation,                 ///< the response or the reference is a rotation [direction]
  kDenominatorNoForce,       ///< the denominator's data type is another [data type]
  kResponseNoMotion,         ///< the response's data type is another [data type]
  kResponseUnknown,          ///< neither data type, label nor unit tell what the response is

  // Quantity and unit. `written` is what the file says of them.
  kQuantityOverruled,        ///< a universal file says another quantity than was chosen, which is believed
  kUnitOverruled,            ///< the unit of columns belongs to another quantity than was chosen
  kUnitOfOtherQuantity,      ///< the unit does not belong to the data type, which is believed
  kUnitUnknown,              ///< the unit is not known; dataset 164 is believed
  kUnitUnknownTakenAsSi,     ///< not known, or of another quantity, and there is no dataset 164
  kUnitInG,                  ///< a label in g, which dataset 164 cannot say, is believed
  kUnitContradicted,         ///< dataset 164 says another unit, and is believed
  kUnitMissing,              ///< no unit and no dataset 164: taken as SI
  kFrequencyUnitUnknown,     ///< the abscissa is taken as Hz
  kPhaseTakenAsRadians,      ///< a phase without a unit, of `entry` [largest]
  kPhaseTakenAsDegrees,      ///< likewise [largest]
  kCoherenceTakenAsPercent,  ///< a coherence far above 1 [largest]

  // Nodes and directions.
  kSeveralNodes,      ///< directions are named with their node [responses' nodes, forces' nodes, first node]
  kTwoNodes,          ///< taken for one place [response's node, force's node]
  kDirectionMissing,  ///< a direction 0 is taken as x
  kDirectionsOverruled,  ///< the file says `written`, and was taken for `entry`

  // Records of taps.
  kMotionTaken,       ///< neither unit nor word tell what the responses are: taken as acceleration in m/s^2
  kForceUnitMissing,  ///< no unit of the force: taken as N
  kResponsesTakenAs,  ///< responses without directions are taken along `written`
  kForceOverruled     ///< the file says that the force is along `written`, and was taken along `entry`
};

struct Remark {
  RemarkKind kind = RemarkKind::kNoFrequencyResponse;
  std::string file;  ///< the input's name
  FilePlace place;
  std::string written;  ///< what the file says there
  std::string entry;    ///< an entry's directions, as xy
  std::vector<double> numbers;
};

/// File, place and a plain sentence. It names no options: a tool adds its own for the remedy, if it has one.
std::string remark_text(const Remark& remark);
/// What the user could change.
Remedy remedy(RemarkKind kind);

/// True when both say the same, be it of two functions: once is enough.
bool same_but_for_place(const Remark& a, const Remark& b);

/// A function that is left out, as the error of a file that has no other.
DataError left_out_error(const Remark& remark);

}  // namespace stablecut::document
