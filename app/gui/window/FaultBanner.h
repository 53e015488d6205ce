// FaultBanner.h - in the safety bar while the output is faulted: when it happened and what, what it means for the
// output, and the next step. It takes the place of facts and limit bars, so nothing moves.
#pragma once

#include <QFrame>
#include <QTime>

#include "app/gui/theme/Labels.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

class FaultBanner final : public QFrame {
    Q_OBJECT
public:
    explicit FaultBanner(QWidget* parent);
    /// Call it thirty times a second in every state: it notes when a fault comes, and whether the gate found every
    /// train within its limits. Shows itself while the bench is faulted. `now`: the time of day.
    void refresh(const Telemetry& telemetry, QTime now = QTime::currentTime());
    /// While blind, the telemetry says nothing of trains, and neither does this.
    void setBlind(bool blind) { blind_ = blind; }
    /// The whole text, for a tool tip and for the log.
    [[nodiscard]] QString text() const;

private:
    void note(const Telemetry& telemetry, QTime now);
    [[nodiscard]] QString outputWords(const Telemetry& telemetry) const;
    void colour();

    ElidedLabel* cause_;
    ElidedLabel* output_;
    ElidedLabel* next_;
    // The refresh before had these:
    Instant at_{0};
    InterlockState state_ = InterlockState::Disconnected;
    std::uint64_t trains_ = 0;
    QTime faultedAt_;            ///< invalid where the fault was there before the bench was opened
    bool unseen_ = false;        ///< trains of this bench that left the gate's table before it was looked at
    bool broken_ = false;        ///< a limit of this bench
    bool notEvaluated_ = false;  ///< a limit of this bench
    bool blind_ = false;
};

}  // namespace tacto::gui
