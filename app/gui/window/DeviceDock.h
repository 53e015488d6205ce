// DeviceDock.h - lists the devices that are present and the open ones: identity, firmware, calibration, what a device
// reports on itself, impedance check. An open device that was unplugged is marked and stays open.
#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QStringList>
#include <QTreeWidget>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/controller/BenchController.h"
#include "app/gui/window/FoldingDock.h"

namespace tacto::gui {

class DeviceDock final : public FoldingDock {
    Q_OBJECT
public:
    DeviceDock(BenchController& controller, const CalibrationBook& calibrations, QWidget* parent);
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] std::vector<int> rowEdges() const override;

signals:
    void simulatedBenchRequested();  ///< asks for a simulated bench with flaws and faults
    void recordingRequested();
    void checkRequested();  ///< asks for the impedance check

private:
    void list();
    void choose(QTreeWidgetItem* item);
    /// Gives each name as many lines as it needs, because similar names differ only at their ends.
    void fitNames();
    void describe();
    /// The roles of the ticked devices, with their URIs.
    [[nodiscard]] std::map<Role, DeviceUri> chosen() const;
    void openChosen();
    void nameOpen();
    /// Looks up the certificate with which the bench was opened; later entries do not change it.
    void lookForCertificate();

    BenchController& controller_;
    const CalibrationBook& calibrations_;
    QTreeWidget* tree_;
    QLabel* facts_;
    QPushButton* open_;
    QPushButton* close_;
    QPushButton* check_;
    QString certificate_;                  ///< the certificate of the open oscilloscope; empty: none was entered
    std::filesystem::path certificateOf_;  ///< the session of the bench for which the certificate was looked up
    std::vector<std::string> listed_;
    std::set<std::string> seen_;  ///< URIs of open devices that were seen plugged in
    QElapsedTimer described_;
};

}  // namespace tacto::gui
