// Any bytes as a capture: read, or refused with a sentence whose advice makes them readable; and measured safely.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/formats/csv/CsvFormat.h"
#include "core/measure/CaptureFile.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/support/TakenAdvice.h"

namespace tacto::fuzz::CaptureCsvFuzz {

TACTO_FUZZ(CaptureCsvFuzz, const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    auto reading = tacto::parseCapture(text, "fuzz.csv");
    if (!reading) {
        if (reading.error().message.empty()) std::abort();
        const auto words = test::advisedWords(reading.error().message);
        if (!words.empty() && !tacto::parseCapture(text, "fuzz.csv", test::withAdvice({}, words))) std::abort();
        return 0;
    }
    for (const auto& channel : tacto::measureCapture(reading->capture).channels) {
        if (channel.measuredPulses > channel.pulses.size()) std::abort();
        // A channel that was not measured must have a warning.
        if (channel.measuredPulses == 0 && channel.warnings.empty()) std::abort();
    }
    return 0;
}

}  // namespace tacto::fuzz::CaptureCsvFuzz
