// DrivePanel.h - what drives the output: nothing, two sliders, or the fingertip; and what the fingertip does, where the
// bench can do that by itself.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QRadioButton>
#include <QSlider>

#include "app/gui/desk/BenchDesk.h"

namespace tacto::gui {

class DrivePanel final : public QWidget {
    Q_OBJECT
public:
    explicit DrivePanel(BenchDesk& desk, QWidget* parent = nullptr);
    /// Another bench, or none.
    void begin();
    void refresh(const Telemetry& telemetry);

private:
    struct Index {
        QSlider* slider;
        QDoubleSpinBox* box;
    };
    [[nodiscard]] Index addIndex(class QGridLayout& grid, int row, const QString& name, const QString& tip);
    void drive();
    void slide();
    [[nodiscard]] QWidget* buildSurfaces();
    [[nodiscard]] QWidget* buildSpeed();

    BenchDesk& desk_;
    QButtonGroup* sources_;
    QRadioButton* off_;
    QRadioButton* byHand_;
    QRadioButton* finger_;
    Index roughness_{}, pressure_{};
    QLabel* says_;
    QWidget* surfaces_;
    QComboBox* material_;
    QDoubleSpinBox* speed_;
    QDoubleSpinBox* force_;
    QWidget* pace_;
    QComboBox* paceBox_;
    InterlockState seen_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
