// Any bytes as digital calibration certificate are read or refused with a sentence, what was read does not contradict
// itself, and a certificate that it makes is one that may be stored (hazards H9 and H10).
#include <cmath>

#include "core/exchange/dcc/DccCertificate.h"
#include "core/exchange/dcc/DsiUnit.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::DccFuzz {

TACTO_FUZZ(DccFuzz, const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (const auto unit = tacto::dsiUnit(text)) tacto::fuzz::require(std::isfinite(unit->factor) && unit->factor > 0);
    const auto file = tacto::dccFrom(text, "input.xml");
    if (!file) {
        tacto::fuzz::require(file.error().message.starts_with("input.xml: "));
        return 0;
    }
    tacto::fuzz::require(!file->items.empty() && !file->number.empty());
    for (const auto& quantity : file->quantities) {
        const auto count = quantity.values.size();
        tacto::fuzz::require(count > 0 && count <= size);
        tacto::fuzz::require(quantity.uncertainties.size() == count || quantity.uncertainties.empty());
        tacto::fuzz::require(quantity.coverageFactors.size() == quantity.uncertainties.size());
    }
    tacto::Certificate given;
    given.serial = file->items.front().serial;
    given.due = tacto::parseDate("2030-01-01").value();
    const auto certificate = tacto::certificateFrom({&*file, 1}, given);
    if (certificate)
        tacto::fuzz::require(tacto::check(certificate->certificate).has_value());
    else
        tacto::fuzz::require(!certificate.error().message.empty());
    return 0;
}

}  // namespace tacto::fuzz::DccFuzz
