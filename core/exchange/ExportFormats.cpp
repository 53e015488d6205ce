#include <algorithm>
#include <array>

#include "core/exchange/Export.h"
#include "core/exchange/csv/CsvExport.h"
#include "core/exchange/edf/EdfExport.h"
#include "core/exchange/hdf5/Hdf5Export.h"
#include "core/exchange/xdf/XdfExport.h"

namespace tacto {

std::span<const ExportFormat* const> exportFormats() {
    static const std::array<const ExportFormat*, 5> formats{
        &csvExport(), &hdf5Export(), &edfExport(), &bdfExport(), &xdfExport(),
    };
    return formats;
}

const ExportFormat* exportFormat(std::string_view name) {
    const auto found = std::ranges::find(exportFormats(), name, &ExportFormat::name);
    return found == exportFormats().end() ? nullptr : *found;
}

}  // namespace tacto
