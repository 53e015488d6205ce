// CsvExport.h - a folder of tables: RFC 4180, UTF-8, a heading in line 1, the time first and `simulated` last, no
// comment lines. Numbers are the shortest decimals that read back exactly; what is absent is an empty cell.
//
// Thread-safety: pure functions.
#pragma once

#include "core/exchange/Export.h"

namespace tacto {

[[nodiscard]] const ExportFormat& csvExport();

/// Returns a channel's name with its unit, as columns are called: "acceleration_x_m_s2", "R".
[[nodiscard]] std::string csvColumn(std::string_view name, std::string_view unit);

}  // namespace tacto
