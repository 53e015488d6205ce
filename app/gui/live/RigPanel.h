// RigPanel.h - sets the speed of the bench's clock and, if touch is simulated, what the finger touches.
#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class RigPanel final : public QWidget {
    Q_OBJECT
public:
    explicit RigPanel(BenchController& controller, QWidget* parent = nullptr);
    /// Starts anew for another bench, or for none. `speed`: of the bench's clock; `recording`: true if it replays one.
    void begin(double speed, bool recording);
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] double speed() const { return paceBox_->currentData().toDouble(); }

signals:
    void replayAgain();

private:
    [[nodiscard]] QWidget* buildSurfaces();
    [[nodiscard]] QWidget* buildPace();
    void endOwnStrokes();
    void present();
    void follow(const QString& material, double speed_mm_s, double force_n);
    void enableRest();

    BenchController& controller_;
    QWidget* surfaces_;
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
