// WiringPanel.h - which devices a run opens, its seed, its clock, and where its files go.
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
    /// Says which devices the protocol needs.
    void show(const ProtocolDeclaration& declaration);
    /// Devices, seed, clock and output of `order`. Errors: InvalidArgument for a text that names no device.
    [[nodiscard]] Result<void> fill(RunOrder& order) const;
    /// "sim:", as written.
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

/// "recording:/a b sim:" as its devices: a blank ends one where the next scheme begins.
[[nodiscard]] Result<std::vector<DeviceUri>> devicesOf(const QString& text);

}  // namespace tacto::gui
