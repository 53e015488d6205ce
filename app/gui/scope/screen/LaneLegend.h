// LaneLegend.h - the lanes of an oscilloscope by their colour: a line, the letter and what a division is.
#pragma once

#include <QLabel>

#include "app/gui/scope/model/ScopeModel.h"

namespace tacto::gui {

/// The colour in which a lane is drawn, in the current theme.
[[nodiscard]] QColor laneColour(const ScopeModel& model, const ScopeLane& lane);
/// The lane's colour for words and numbers: at least 4.5:1 on the screen's ground.
[[nodiscard]] QColor laneInk(const ScopeModel& model, const ScopeLane& lane);

class LaneLegend final : public QLabel {
    Q_OBJECT
public:
    /// `model` outlives this.
    LaneLegend(const ScopeModel& model, QWidget* parent);

private:
    void follow();

    const ScopeModel& model_;
};

}  // namespace tacto::gui
