// Reads any JSON as a record of the calibration store, any file as that store, and any lines of JSON as the stores of
// certificates and of load-safety checks. Each must be read, or refused with a sentence, and nothing of unknown origin
// may be valid (hazards H9 and H10). The first byte chooses the kind of input.
#include <cstdlib>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "core/base/JsonText.h"
#include "core/calibration/CalibrationStore.h"
#include "core/calibration/CertificateStore.h"
#include "core/calibration/ChainedLines.h"
#include "core/calibration/LoadSafetyStore.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::CalibrationStoreFuzz {

namespace {

using namespace tacto;

void checkRecord(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
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

/// Makes a file of these lines with a valid chain; without it no line would be read.
std::filesystem::path chained(std::span<const std::uint8_t> bytes) {
    const auto path = fuzz::scratchFolder() / "chained.jsonl";
    std::filesystem::remove(path);
    std::filesystem::remove(path.string() + ".end");
    constexpr std::size_t kMaxLines = 8;  // each line is committed to a disk
    std::istringstream lines(std::string(bytes.begin(), bytes.end()));
    std::size_t count = 0;
    for (std::string line; count < kMaxLines && std::getline(lines, line);) {
        const auto json = parseJson(line, "fuzz.json");
        if (!json || !json->is_object()) continue;
        ChainedLines file(path, "line");
        const auto added = file.append([&]() -> Result<nlohmann::json> {
            const auto read = file.read([](const nlohmann::json&) { return Result<void>(); });
            if (!read) return failure(read);
            return *json;
        });
        if (!added) std::abort();
        ++count;
    }
    return path;
}

void checkCertificates(std::span<const std::uint8_t> bytes) {
    const auto store = CertificateStore::open(chained(bytes));
    if (!store) {
        if (store.error().message.empty()) std::abort();
        return;
    }
    const auto day = *parseDate("2026-11-23");
    for (const auto& [certificate, entered, withdrawn] : store->all()) {
        if (!check(certificate)) std::abort();
        const auto newest = store->newest(certificate.serial, day);
        if (!newest) continue;
        const auto& found = store->all()[*newest];
        if (found.withdrawn || found.certificate.serial != certificate.serial) std::abort();
        if (store->state(*newest, day) == CertificateState::Counts &&
            (found.certificate.date > day || found.certificate.due < day))
            std::abort();
    }
}

void checkLoadSafety(std::span<const std::uint8_t> bytes) {
    const auto store = LoadSafetyStore::open(chained(bytes));
    if (!store) {
        if (store.error().message.empty()) std::abort();
        return;
    }
    for (const auto& one : store->all()) {
        const auto* latest = store->latest(one.serial);
        if (latest != nullptr && (latest->simulated || latest->serial != one.serial)) std::abort();
        LoadSafetyNeed need;
        need.serial = one.serial;
        need.day = *parseDate("2026-11-23");
        need.scriptSha256 = one.scriptSha256;
        need.area = SquareCentimetres(1000);
        need.reach = {.interval_s = 1000, .lowest_ohm = 1e6, .highest_ohm = 1e-6};
        need.tolerances = {.load_pct = 1000, .amplitude_pct = 1000};
        const auto counts = store->passed(need);
        if (!counts) {
            if (counts.error().message.empty()) std::abort();
            continue;
        }
        if (latest == nullptr || *counts != *latest || counts->verdict != CheckVerdict::Pass) std::abort();
        if (counts->simulated || !counts->area || counts->sessionHead.empty()) std::abort();
        if (counts->made > need.day ||
            std::chrono::sys_days(need.day) - std::chrono::sys_days(counts->made) > kLoadSafetyHolds)
            std::abort();
    }
}

}  // namespace

TACTO_FUZZ(CalibrationStoreFuzz, const std::uint8_t* data, std::size_t size) {
    constexpr void (*kChecks[])(std::span<const std::uint8_t>) = {checkRecord, checkStore, checkCertificates,
                                                                  checkLoadSafety};
    if (size > 0) kChecks[data[0] % std::size(kChecks)]({data + 1, size - 1});
    return 0;
}

}  // namespace tacto::fuzz::CalibrationStoreFuzz
