// Any text as an instrument's profile is refused with a sentence, or gives a profile that can state its figures and
// recognises its own models (H9).
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/measure/InstrumentStatement.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::InstrumentProfileFuzz {

namespace {

void requireSheet(const tacto::SheetFigure& figure, double most) {
    if (std::isnan(figure.value)) return;
    require(figure.value >= 0 && figure.value <= most && figure.perYear >= 0 && figure.perYear <= most);
    require(!figure.source.empty() && !figure.address.empty());
}

}  // namespace

TACTO_FUZZ(InstrumentProfileFuzz, const std::uint8_t* data, std::size_t size) {
    const auto profile = tacto::parseInstrumentProfile({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    if (!profile) {
        require(profile.error().code == tacto::ErrorCode::ParseError);
        require(profile.error().message.starts_with("fuzz.json: "));
        return 0;
    }
    require(!profile->id.empty() && !profile->title.empty());
    requireSheet(profile->gain, 0.5);
    requireSheet(profile->timeBase, 0.1);
    require(!profile->makers.empty() && !profile->models.empty());
    for (const auto& model : profile->models) require(profile->matches(profile->makers.back() + " " + model));
    const auto stated = profile->statement();
    require(stated.timeBase.known() == !std::isnan(profile->timeBase.value));
    require(stated.voltage.gain.known() == !std::isnan(profile->gain.value));
    return 0;
}

}  // namespace tacto::fuzz::InstrumentProfileFuzz
