// SimulatedBenchDialog.h - lets the user set up a simulated bench for training and demonstration: source, load, flaws,
// and a fault at a chosen time. For a Live bench, and in the wiring of a run.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <set>
#include <vector>

#include "app/gui/theme/FieldForm.h"
#include "core/base/Words.h"
#include "core/devices/DeviceUri.h"

namespace tacto::gui {

class SimulatedBenchDialog final : public QDialog {
    Q_OBJECT
public:
    /// `accept`: the words of the button that takes the bench. Begins with what the simulated devices in `before` are
    /// like. `needs`: the roles that are simulated; empty: all.
    SimulatedBenchDialog(const QString& accept, const std::vector<DeviceUri>& before, const std::set<Role>& needs,
                         QWidget* parent);

signals:
    /// `devices`: their addresses, a blank between them.
    void chosen(const QString& devices, quint64 seed);

private:
    /// `values`: the typed values of the form.
    void begin(const std::vector<DeviceUri>& before);
    void beginWith(const std::string& device, const QString& fault);
    [[nodiscard]] QStringList uris(const nlohmann::json& values) const;
    void judge();
    void take();

    std::vector<const char*> devices_;
    FieldForm* form_;
    QLabel* says_;
    QPushButton* open_;
};

}  // namespace tacto::gui
