// WiringPanel.h - form for the devices that a run opens, its seed, its clock and its output folder.
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <set>
#include <vector>

#include "app/gui/controller/SideWork.h"
#include "app/gui/theme/Labels.h"
#include "app/run/ProtocolRun.h"

namespace tacto::gui {

class WiringPanel final : public QWidget {
    Q_OBJECT
public:
    explicit WiringPanel(QWidget* parent = nullptr);
    /// Shows which devices the protocol needs.
    void show(const ProtocolDeclaration& declaration);
    /// Sets what knows the drivers, as BenchController::allVirtual(); then addresses are checked as they are typed.
    void checkWith(std::function<Result<bool>(const std::vector<DeviceUri>&)> known);
    /// Returns why the devices cannot be used, as far as that shows before they are opened; empty if they can.
    [[nodiscard]] QString refused() const { return refused_; }
    /// Fills in devices, seed, clock and output of `order`. Errors: InvalidArgument for text that names no device.
    [[nodiscard]] Result<void> fill(RunOrder& order) const;
    /// Returns the devices as typed, such as "sim:".
    [[nodiscard]] QString devices() const { return devices_->text().trimmed(); }
    void removeFaults();

signals:
    void edited();

private:
    [[nodiscard]] QWidget* buildDevices();
    [[nodiscard]] QWidget* buildOutput();
    void useOscilloscope(const QString& address);
    void setDevices(const QString& addresses);
    void addFolder(const QString& scheme, const QString& title);
    void judge();
    void check();
    void refuse(const QString& why);
    QLabel* needs_;
    std::set<Role> roles_;  // that the protocol needs
    QLineEdit* devices_ = nullptr;
    TroubleLine* trouble_;
    QString refused_;
    QSpinBox* seed_;
    QCheckBox* realtime_;
    QLineEdit* out_ = nullptr;
    QTimer checkLater_;
    std::function<Result<bool>(const std::vector<DeviceUri>&)> known_;
    SideWork checking_;
};

/// Splits "recording:/a b sim:" into devices; a blank ends a device only if a scheme follows.
[[nodiscard]] Result<std::vector<DeviceUri>> devicesOf(const QString& text);

/// True for a simulated device with a fault.
[[nodiscard]] bool simulatesFault(const DeviceUri& device);

}  // namespace tacto::gui
