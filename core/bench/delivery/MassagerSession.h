// MassagerSession.h - the only caller of a massager that stands in for the electrodes: sends approved bursts at their
// onset, and switches it off when the control loop is silent.
//
// One burst is in the session at a time: it is idle again when its report was made.
//
// Thread-safety: serve() has one caller, the device's thread (on the virtual clock, the bench); post() has one, the
// control loop. The rest as OutputSession.
#pragma once

#include "core/bench/delivery/OutputSession.h"
#include "core/devices/Massager.h"

namespace tacto {

struct BurstOrder {
    ApprovedBurst burst;
    Instant onset;
    Seconds interval;
};

class MassagerSession : public OutputSession<Massager, BurstOrder> {
public:
    /// All arguments outlive the session. `wake` is called after post(); may be empty.
    MassagerSession(Massager& device, const SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock,
                    std::function<void()> wake)
        : OutputSession(device, gate, heartbeat, clock, std::move(wake)) {}

    /// Hands over a burst to be sent at `onset`. The session must be idle(). `interval` is for the report, whose
    /// `amplitude` is the intensity, 0 to 1; nothing of a burst is read back.
    void post(ApprovedBurst&& burst, Instant onset, Seconds interval) noexcept {
        OutputSession::post({std::move(burst), onset, interval});
    }

    /// Does what is due and returns when it wants to be called again.
    Instant serve(Instant now) noexcept;

private:
    void send(BurstOrder&& order, Instant now) noexcept;
};

}  // namespace tacto
