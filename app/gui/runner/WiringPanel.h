// WiringPanel.h - form for the devices that a run opens, its seed, its clock and its output folder.
#pragma once

#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QWidget>

#include "app/gui/theme/Labels.h"
#include "app/run/ProtocolRun.h"

namespace tacto::gui {

class WiringPanel final : public QWidget {
    Q_OBJECT
public:
    explicit WiringPanel(QWidget* parent = nullptr);
    /// Shows which devices the protocol needs.
    void show(const ProtocolDeclaration& declaration);
    /// Fills in devices, seed, clock and output of `order`. Errors: InvalidArgument for text that names no device.
    [[nodiscard]] Result<void> fill(RunOrder& order) const;
    /// Returns the devices as typed, such as "sim:".
    [[nodiscard]] QString devices() const { return devices_->text().trimmed(); }

signals:
    void edited();

private:
    [[nodiscard]] QWidget* buildDevices();
    [[nodiscard]] QWidget* buildOutput();
    void useOscilloscope(const QString& address);
    void addFolder(const QString& scheme, const QString& title);
    void judge();
    QLabel* needs_;
    QLineEdit* devices_ = nullptr;
    TroubleLine* trouble_;
    QSpinBox* seed_;
    QCheckBox* realtime_;
    QLineEdit* out_ = nullptr;
};

/// Splits "recording:/a b sim:" into devices; a blank ends a device only if a scheme follows.
[[nodiscard]] Result<std::vector<DeviceUri>> devicesOf(const QString& text);

}  // namespace tacto::gui
