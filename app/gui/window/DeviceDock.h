// DeviceDock.h - what is present, what is open, and what can be done with it: identity, firmware, calibration,
// impedance check.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <map>

#include "app/gui/desk/BenchDesk.h"

namespace tacto::gui {

class DeviceDock final : public QDockWidget {
    Q_OBJECT
public:
    DeviceDock(BenchDesk& desk, QWidget* parent);
    /// A load to check against; empty asks for the last one again.
    void refresh(const Telemetry& telemetry);

signals:
    void simulatedBenchRequested();  ///< with flaws and faults
    void recordingRequested();
    void checkRequested();  ///< the impedance check

private:
    void list();
    void choose(QTreeWidgetItem* item);
    void describe();
    /// The roles of the devices that are ticked, with their URIs.
    [[nodiscard]] std::map<Role, DeviceUri> chosen() const;
    void openChosen();
    void nameOpen();

    BenchDesk& desk_;
    QTreeWidget* tree_;
    QLabel* facts_;
    QPushButton* open_;
    QPushButton* close_;
    QPushButton* check_;
    std::vector<std::string> listed_;
};

}  // namespace tacto::gui
