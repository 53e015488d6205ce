// Any text as a table of results (trials, readings of a calibration, a profilometer's export, answers of an
// identification) is read, or refused with a sentence that names the file; infinite values are never read (hazard H10).
// The first byte chooses the table.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/identification/Identification.h"
#include "core/analysis/identification/IdentificationFile.h"
#include "core/analysis/sensor_calibration/ProfilometerFile.h"
#include "core/analysis/separability/Separability.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::ResultTablesFuzz {

namespace {

using namespace tacto;

template <class T>
bool refusedByName(const Result<T>& read) {
    if (read) return false;
    if (read.error().message.find("fuzz.csv") == std::string::npos) std::abort();
    return true;
}

void checkTrials(std::string_view text) {
    const auto trials = parseSeparabilityTrials(text, "fuzz.csv");
    if (refusedByName(trials)) return;
    const auto judged = judgeSeparability(*trials);
    if (!judged && judged.error().message.empty()) std::abort();
}

void checkReadings(std::string_view text) {
    const auto readings = parseCalibrationReadings(text, "fuzz.csv");
    if (refusedByName(readings)) return;
    for (const auto& reading : *readings) {
        if (!std::isfinite(reading.commanded) || std::isinf(reading.measured)) std::abort();
    }
}

void checkProfilometer(std::string_view text) {
    const auto reading = parseProfilometer(text, "fuzz.csv");
    if (refusedByName(reading)) return;
    if (!(reading->ra_um > 0) || !std::isfinite(reading->ra_um) || reading->raValues == 0) std::abort();
    if (reading->rz_um < reading->ra_um) std::abort();
}

void checkIdentification(std::string_view text) {
    const auto participants = parseIdentificationTrials(text, "fuzz.csv");
    if (refusedByName(participants)) return;
    if (participants->empty()) std::abort();
    for (const auto& participant : *participants) {
        const auto trials = participant.trials();
        const auto identified = identifyAsMet(trials);
        if (!identified && identified.error().message.empty()) std::abort();
        if (!identified) continue;
        const auto& all = identified->all;
        if (all.hits > all.n || all.n + identified->catches.n + identified->noAnswer > trials.size()) std::abort();
        if (identified->confusion.size() != identified->labels.size()) std::abort();
    }
}

}  // namespace

TACTO_FUZZ(ResultTablesFuzz, const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
    constexpr void (*kChecks[])(std::string_view) = {checkTrials, checkReadings, checkProfilometer,
                                                     checkIdentification};
    kChecks[data[0] % std::size(kChecks)](text);
    return 0;
}

}  // namespace tacto::fuzz::ResultTablesFuzz
