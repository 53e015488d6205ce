// ExposureTable.h - exposure rows against their limits: quantity, value, limit, and a bar of how much of it is used;
// hatched where a row was not evaluated.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTableWidget>
#include <span>

#include "core/safety/Exposure.h"

namespace tacto::gui {

class ExposureTable final : public QTableWidget {
    Q_OBJECT
public:
    explicit ExposureTable(QWidget* parent = nullptr);
    /// What kind of limit it is stands in the tool tip alone.
    void setCompact(bool compact) { compact_ = compact; }
    void show(std::span<const ExposureRow> rows);

private:
    bool compact_ = false;
};

/// "RMS current over 5 s into 500 Ω".
[[nodiscard]] QString rowTitle(const ExposureRow& row);
/// "< 10 mA", "≤ 2 mA/cm² (warning)", "–" without a limit.
[[nodiscard]] QString limitText(const ExposureRow& row, bool compact = false);
[[nodiscard]] QString text(std::string_view utf8);

}  // namespace tacto::gui
