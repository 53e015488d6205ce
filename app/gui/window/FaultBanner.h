// FaultBanner.h - in the safety bar while the output is faulted: what happened, what it means for the output, and the
// next step. It takes the place of facts and limit bars, so nothing moves.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>

#include "app/gui/theme/ElidedLabel.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

class FaultBanner final : public QFrame {
    Q_OBJECT
public:
    explicit FaultBanner(QWidget* parent);
    /// Call it thirty times a second while the bench is faulted.
    void show(const Telemetry& telemetry);
    /// All of it, for a tool tip and for the log.
    [[nodiscard]] QString text() const;

protected:
    void changeEvent(QEvent* event) override;

private:
    void colour();

    ElidedLabel* cause_;
    ElidedLabel* output_;
    ElidedLabel* next_;
};

}  // namespace tacto::gui
