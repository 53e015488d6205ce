#include "core/measure/TrainGrouping.h"

#include <cmath>
#include <utility>

#include "core/base/LargeReserve.h"

namespace tacto {

TrainGrouping::TrainGrouping(double gap, std::span<const std::size_t> breaks, std::size_t pulses)
    : gap_(gap), breaks_(breaks) {
    // Without a gap each pulse is a train.
    if (!(gap > 0)) reserveLarge(trains_, pulses);
}

void TrainGrouping::add(const PulseMeasurement& pulse) {
    const bool afterBreak = !breaks_.empty() && breaks_.front() == added_;
    if (afterBreak) breaks_ = breaks_.subspan(1);
    // Known also of a pulse that was flagged and whose numbers are gone.
    const double onset_s = std::isnan(pulse.onset_s()) ? pulse.seenFrom_s : pulse.onset_s();
    if (added_ == 0 || afterBreak || !(onset_s - lastOnset_s_ <= gap_)) begin(pulse, afterBreak);
    lastOnset_s_ = onset_s;
    ++added_;

    auto& train = trains_.back();
    if (!pulse.flags.measured()) {
        ++train.flagged;
        return;
    }
    ++train.pulses;
    train.amplitude += std::abs(pulse.leading.plateau);
    train.width_s += pulse.leading.width_s;
    train.charge += std::abs(pulse.leading.charge);
    train.imbalance += pulse.imbalance;
    train.polarity += pulse.leading.plateau > 0 ? 1 : -1;
}

std::vector<TrainMeasurement> TrainGrouping::finish() {
    if (!trains_.empty()) end();
    return std::move(trains_);
}

void TrainGrouping::begin(const PulseMeasurement& pulse, bool afterBreak) {
    if (!trains_.empty()) {
        end();
        // A flagged first pulse leaves its onset NaN, and with it this interval and the one before.
        if (!afterBreak) trains_.back().interval_s = pulse.onset_s() - trains_.back().onset_s;
    }
    auto& train = trains_.emplace_back();
    train.onset_s = pulse.onset_s();
    train.amplitude = train.width_s = train.charge = train.imbalance = 0;
}

void TrainGrouping::end() {
    auto& train = trains_.back();
    const double n = train.pulses > 0 ? static_cast<double>(train.pulses) : kNotMeasured;
    train.amplitude /= n;
    train.width_s /= n;
    train.charge /= n;
    train.imbalance /= n;
    if (train.pulses > 0) train.polarity = train.polarity >= 0 ? 1 : -1;
}

}  // namespace tacto
