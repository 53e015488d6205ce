// DeviceDock.h - what is present, what is open, and what can be done with it: identity, firmware, calibration,
// impedance check.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QTreeWidget>

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
    void describe();
    void openSelected();

    BenchDesk& desk_;
    QTreeWidget* tree_;
    QLabel* facts_;
    QPushButton* open_;
    QPushButton* close_;
    QPushButton* check_;
    QTimer hotPlug_;
    std::vector<std::string> listed_;
};

}  // namespace tacto::gui
