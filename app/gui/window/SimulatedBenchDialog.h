// SimulatedBenchDialog.h - lets the user set up a simulated bench for training and demonstration: source, load, flaws,
// and a fault at a chosen time.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/FieldForm.h"

namespace tacto::gui {

class SimulatedBenchDialog final : public QDialog {
    Q_OBJECT
public:
    explicit SimulatedBenchDialog(BenchController& controller, QWidget* parent);

private:
    /// `values`: the typed values of the form.
    [[nodiscard]] std::vector<std::string> uris(const nlohmann::json& values) const;
    void judge();
    void openBench();

    BenchController& controller_;
    FieldForm* form_;
    QLabel* says_;
    QPushButton* open_;
};

}  // namespace tacto::gui
