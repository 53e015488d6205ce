// CertificateTable.h - every certificate that was entered, the newest first, and how each stands today: a row each, and
// as many columns as there is room for.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTableWidget>

#include "core/calibration/CertificateStore.h"

namespace tacto::gui {

/// "U gain (%)", as the form names it too.
[[nodiscard]] QString figureTitle(const CertificateFigure& figure);

class CertificateTable final : public QTableWidget {
public:
    explicit CertificateTable(QWidget* parent);
    void show(const CertificateStore& store, CalibrationDate today);
    /// Hides columns until the others have room; a row's tool tip tells all of them.
    void fitColumns();
    /// Index into the store of the row that is chosen; -1: none, or it is withdrawn.
    [[nodiscard]] int chosen() const;
    /// Empty: none.
    [[nodiscard]] QString chosenNumber() const;
};

}  // namespace tacto::gui
