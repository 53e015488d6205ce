// RigPanel.h - what the simulated finger touches, where the bench can do that by itself, and how fast its time runs.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <array>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class RigPanel final : public QWidget {
    Q_OBJECT
public:
    explicit RigPanel(BenchController& controller, QWidget* parent = nullptr);
    /// Another bench, or none. `speed` is what its time runs at; `recording` whether one is replayed.
    void begin(double speed, bool recording);
    void refresh(const Telemetry& telemetry);
    /// In fewer lines.
    void setLow(bool low);
    [[nodiscard]] double speed() const { return paceBox_->currentData().toDouble(); }

signals:
    void replayAgain();

private:
    [[nodiscard]] QWidget* buildSurfaces();
    [[nodiscard]] QWidget* buildPace();
    void layFields();
    void endOwnStrokes();
    void present();
    void follow(const QString& material, double speed_mm_s, double force_n);
    void enableRest();

    BenchController& controller_;
    QWidget* surfaces_;
    QGridLayout* fields_ = nullptr;
    std::array<QLabel*, 3> labels_{};  // labels for material, speed and force
    bool low_ = false;
    QComboBox* material_;
    QDoubleSpinBox* speed_;
    QDoubleSpinBox* force_;
    QWidget* pace_;
    QLabel* paceLabel_;
    QComboBox* paceBox_;
    QPushButton* again_;
    bool recording_ = false;
};

}  // namespace tacto::gui
