#include <algorithm>
#include <array>

#include "core/exchange/Export.h"
#include "core/exchange/bids/BidsExport.h"
#include "core/exchange/csv/CsvExport.h"
#include "core/exchange/dcc/DccExport.h"
#include "core/exchange/edf/EdfExport.h"
#include "core/exchange/hdf5/Hdf5Export.h"
#include "core/exchange/xdf/XdfExport.h"

namespace tacto {

std::span<const ExportFormat* const> exportFormats() {
    static const std::array<const ExportFormat*, 6> formats{
        &csvExport(), &hdf5Export(), &edfExport(), &bdfExport(), &xdfExport(), &bidsExport(),
    };
    return formats;
}

const ExportFormat* exportFormat(std::string_view name) {
    if (name == dccExport().name) return &dccExport();
    const auto found = std::ranges::find(exportFormats(), name, &ExportFormat::name);
    return found == exportFormats().end() ? nullptr : *found;
}

}  // namespace tacto
