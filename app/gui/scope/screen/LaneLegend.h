// LaneLegend.h - a legend of the oscilloscope's lanes: a line in each lane's colour, its letter and its scale.
#pragma once

#include <QLabel>

#include "app/gui/scope/model/ScopeModel.h"

namespace tacto::gui {

/// The colour of a channel of a capture, wherever it is shown, by its letter and its place in the capture.
[[nodiscard]] QColor channelColour(const QString& letter, std::size_t channel);
/// The same for text: contrast of at least 4.5:1 on the screen's background.
[[nodiscard]] QColor channelInk(const QString& letter, std::size_t channel);
/// The colour in which a lane is drawn, in the current theme.
[[nodiscard]] QColor laneColour(const ScopeModel& model, const ScopeLane& lane);
/// The lane's colour for text: contrast of at least 4.5:1 on the screen's background.
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
