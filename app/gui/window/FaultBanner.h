// FaultBanner.h - shown in the safety bar while the output is faulted: time and cause of the fault, what it means for
// the output, and the next step. It replaces facts and limit bars, so that nothing moves.
#pragma once

#include <QFrame>
#include <QTime>
#include <optional>

#include "app/gui/theme/Labels.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

class FaultBanner final : public QFrame {
    Q_OBJECT
public:
    explicit FaultBanner(QWidget* parent);
    /// Call it 30 times a second in every state: it notes when a fault comes, and whether the gate found every train
    /// within its limits. Shows itself while the bench is faulted. `now`: the time of day.
    void refresh(const Telemetry& telemetry, QTime now = QTime::currentTime());
    /// While the operator is blind, neither the telemetry nor this banner says anything about trains.
    void setBlind(bool blind) { blind_ = blind; }
    /// True if the output may be armed as soon as the fault of the last refreshes is reset. False if one of its causes
    /// needs a check before, or if an earlier program left it, of which not every cause is known.
    [[nodiscard]] bool mayArmNext() const { return mayArm_; }
    /// The full text for a tool tip and for the log.
    [[nodiscard]] QString text() const;

private:
    void note(const Telemetry& telemetry, QTime now);
    [[nodiscard]] QString outputWords(const Telemetry& telemetry) const;
    void colour();

    ElidedLabel* cause_;
    ElidedLabel* output_;
    ElidedLabel* next_;
    // Values of the previous refresh:
    Instant at_{0};
    InterlockState state_ = InterlockState::Disconnected;
    std::uint64_t trains_ = 0;
    QTime faultedAt_;            ///< invalid if the fault existed before the bench was opened
    bool unseen_ = false;        ///< some trains of this bench left the gate's table unread
    bool broken_ = false;        ///< this bench exceeded a limit
    bool notEvaluated_ = false;  ///< a limit of this bench was not evaluated
    bool mayArm_ = false;        ///< every cause since the fault began allows it
    bool asJudged_ = false;      ///< no cause since the fault began contradicts what the gate judged
    bool blind_ = false;
};

}  // namespace tacto::gui
