// ExposureDock.h - every row of the exposure table against its limit.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDockWidget>

#include "app/gui/look/ExposureTable.h"
#include "core/bench/Telemetry.h"

namespace tacto::gui {

class ExposureDock final : public QDockWidget {
    Q_OBJECT
public:
    explicit ExposureDock(QWidget* parent);
    void refresh(const Telemetry& telemetry);

private:
    ExposureTable* table_;
    Instant shownAt_{-1};
};

}  // namespace tacto::gui
