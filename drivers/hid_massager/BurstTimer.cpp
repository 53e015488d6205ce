#include "drivers/hid_massager/BurstTimer.h"

#include <algorithm>

namespace tacto::hid {

BurstTimer::Due BurstTimer::next() const noexcept {
    if (stopAt_ && !(asked_ && echo_)) return {HidWrite::Stop, *stopAt_};
    if (asked_) return {HidWrite::Burst, spaced()};
    if (!end_) return {};
    if (keepAlive_.count() > 0 && repeatAt_ < *end_) return {HidWrite::Repeat, std::max(repeatAt_, spaced())};
    return {HidWrite::Stop, *end_};
}

void BurstTimer::askBurst(Instant duration) noexcept { asked_ = duration; }

void BurstTimer::askStop() noexcept {
    asked_.reset();
    end_.reset();
    stopAt_ = Instant(0);
    echo_ = false;
}

void BurstTimer::wrote(HidWrite what, Instant began, Instant ended, bool taken) noexcept {
    const bool tooSoon = began < spaced();
    last_ = ended;
    if (what == HidWrite::Stop) {
        end_.reset();
        stopAt_.reset();
        if (!taken) {
            stopAt_ = ended + kRetry;
            echo_ = false;
        } else if (tooSoon) {
            stopAt_ = ended + shortest_;
            echo_ = true;
        }
        return;
    }
    if (!taken) return askStop();             // the device may or may not have taken the report
    if (what == HidWrite::Burst && asked_) {  // forceOff() may have dropped the burst meanwhile
        end_ = ended + *asked_;
        asked_.reset();
        stopAt_.reset();
    }
    repeatAt_ = ended + keepAlive_;
}

}  // namespace tacto::hid
