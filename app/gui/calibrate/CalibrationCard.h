// CalibrationCard.h - shows whether a stimulator's calibration is valid today: a word and a shape, then the
// calibration's values, then what to do.
#pragma once

#include <QComboBox>
#include <QFrame>
#include <QLabel>
#include <QPushButton>

#include "app/gui/calibrate/CalibrationBook.h"

namespace tacto::gui {

class CalibrationCard final : public QFrame {
    Q_OBJECT
public:
    explicit CalibrationCard(CalibrationBook& book, QWidget* parent = nullptr);
    /// Returns the stimulator shown; nothing if none is known.
    [[nodiscard]] std::optional<StimulatorId> shown() const;
    /// Sets whether a run can be started: not during a run, or if nothing can run.
    void setReady(bool ready);

signals:
    void calibrateWanted();
    void checkWanted();
    void stimulatorChosen();

private:
    void fill();
    void tell(const StimulatorId& stimulator);
    void colour();
    CalibrationBook& book_;
    std::vector<StimulatorId> listed_;
    QComboBox* chooser_;
    QLabel* word_;
    QLabel* facts_;
    QPushButton* calibrate_;
    QPushButton* check_ = nullptr;
    std::optional<StimulatorId> lastOpen_;
    bool counts_ = false;
    bool warns_ = false;
    bool ready_ = false;
};

}  // namespace tacto::gui
