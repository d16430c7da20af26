// Tool paths as text: CSV with a header, bare columns, and the lines that post-processors write.
#pragma once

#include "document/kinds/tool_path_json.h"

namespace stablecut::document {

/// Reads `X.. Y.. Z.. I.. J.. K..` words (straight moves, absolute, mm; F in mm/min; what a line leaves out
/// stays), `GOTO/x,y,z,i,j,k`, a table with a header (x, y, z; i, j, k or axis_x, axis_y, axis_z; feed_x,
/// ...; speed; with units), or 3 or 6 bare columns. i, j, k point from the tip to the holder unless the
/// defaults say otherwise, axis_x, ... from the holder to the tip; none is 0, 0, 1 up from the workpiece.
/// Throws DataError.
ToolPathDocument tool_path_from_text(const Source& source, const ToolPathDefaults& defaults);

}  // namespace stablecut::document
