// SimulatedBenchDialog.h - a simulated bench as the user sets it: source, load, flaws and a fault at a moment, for
// training and demonstration.
#pragma once

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class SimulatedBenchDialog final : public QDialog {
    Q_OBJECT
public:
    explicit SimulatedBenchDialog(BenchController& controller, QWidget* parent);

private:
    [[nodiscard]] std::vector<std::string> uris() const;
    void judge();
    void openBench();

    BenchController& controller_;
    QComboBox* mode_;
    QLineEdit* load_;
    QDoubleSpinBox* gain_;
    QComboBox* fault_;
    QDoubleSpinBox* faultAt_;
    QSpinBox* seed_;
    QLabel* says_;
    QPushButton* open_;
};

}  // namespace tacto::gui
