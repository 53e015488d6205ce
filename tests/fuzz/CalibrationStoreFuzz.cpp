// Any file as the store of calibrations, and any JSON as one of its records: read or refused with a sentence, and
// nothing whose provenance is not known counts as valid (hazards H9 and H10). The first byte says which of the two.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/JsonText.h"
#include "core/calibration/CalibrationStore.h"
#include "core/calibration/StoredCalibrationJson.h"
#include "tests/fuzz/InputFile.h"

namespace {

using namespace tacto;

void checkRecord(std::string_view text) {
    const auto json = parseJson(text, "fuzz.json");
    if (!json) return;
    const auto calibration = storedCalibrationFrom(*json);
    if (!calibration) {
        if (calibration.error().message.empty()) std::abort();
        return;
    }
    const auto again = storedCalibrationFrom(toJson(*calibration));
    if (!again || toJson(*again) != toJson(*calibration)) std::abort();
}

void checkStore(std::span<const std::uint8_t> bytes) {
    const auto store = CalibrationStore::open(fuzz::inputFile("calibrations.jsonl", bytes));
    if (!store) {
        if (store.error().message.empty()) std::abort();
        return;
    }
    for (const auto& calibration : store->all()) {
        const auto valid = store->valid(calibration.serial, calibration.unit, *parseDate("2026-11-23"), false);
        if (valid && !checkProvenance(*valid)) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    if (data[0] % 2 == 0) {
        checkRecord({reinterpret_cast<const char*>(data + 1), size - 1});
    } else {
        checkStore({data + 1, size - 1});
    }
    return 0;
}
