// SimulatedBenchDialog.h - lets the user set up a simulated bench for training and demonstration: source, load, flaws,
// and a fault at a chosen time. For a Live bench, and in the wiring of a run.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include "app/gui/theme/FieldForm.h"

namespace tacto::gui {

class SimulatedBenchDialog final : public QDialog {
    Q_OBJECT
public:
    /// `accept`: the words of the button that takes the bench.
    explicit SimulatedBenchDialog(const QString& accept, QWidget* parent);

signals:
    /// `devices`: their addresses, a blank between them.
    void chosen(const QString& devices, quint64 seed);

private:
    /// `values`: the typed values of the form.
    [[nodiscard]] QStringList uris(const nlohmann::json& values) const;
    void judge();
    void take();

    FieldForm* form_;
    QLabel* says_;
    QPushButton* open_;
};

}  // namespace tacto::gui
