#include "app/gui/runner/LoadCaptures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/JsonText.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

double peakIn(const Capture& capture, std::string_view unit) {
    double peak = -1;
    for (const auto& channel : capture.channels) {
        if (channel.unit != unit) continue;
        for (const float sample : channel.samples)
            if (std::isfinite(sample)) peak = std::max(peak, std::abs(double(sample)));
        break;
    }
    return peak;
}

Result<std::shared_ptr<const Capture>> strongestOn(const std::filesystem::path& session, const std::string& load,
                                                   bool ofVoltage) {
    const auto reader = SessionReader::open(session);
    if (!reader) return failure(reader);
    const auto trials = reader->trials();
    if (!trials) return failure(trials);
    const auto captures = reader->captures();
    if (!captures) return failure(captures);
    std::set<int> ofLoad;
    for (const auto& trial : *trials) {
        if (textOr(trial.measured, "type") == "command" && textOr(trial.measured, "load") == load)
            ofLoad.insert(trial.number);
    }
    std::shared_ptr<const Capture> strongest;
    double most = -1;
    for (const auto& info : *captures) {
        if (!info.trial || !ofLoad.contains(*info.trial)) continue;
        auto capture = reader->capture(info.seq);
        if (!capture) return failure(capture);
        if (capture->untriggered) continue;
        const double amps = ofVoltage ? -1 : peakIn(*capture, "A");
        const double peak = amps >= 0 ? amps : peakIn(*capture, "V");
        if (!(peak > most)) continue;
        most = peak;
        strongest = std::make_shared<const Capture>(std::move(*capture));
    }
    return strongest;
}

}  // namespace tacto::gui
