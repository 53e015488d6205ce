// ExposureTable.h - a table of exposure and limits: quantity, value, limit, and a bar of the used share; hatched if a
// row was not evaluated. In a narrow place the bar is below the quantity.
#pragma once

#include <QString>
#include <QTableWidget>
#include <span>
#include <vector>

#include "core/safety/LimitSet.h"

namespace tacto::gui {

class ExposureTable final : public QTableWidget {
    Q_OBJECT
public:
    explicit ExposureTable(QWidget* parent = nullptr);
    /// Shows the rows grouped by limit set, each group under the set's title in `sets`.
    void show(std::span<const ExposureRow> rows, std::span<const LimitSet> sets);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void measure();
    void fill();
    [[nodiscard]] QString titleOfSet(const ExposureRow& row) const;
    [[nodiscard]] QTableWidgetItem* cell(int line, int column, const QString& shown);
    void showSection(int line, const QString& title);
    void showRow(int line, const ExposureRow& row);

    std::vector<ExposureRow> rows_;
    std::vector<std::pair<std::string, QString>> titles_;  ///< titles of the rows' sets, by id
    bool compact_ = false;  ///< narrow: the bar is below the quantity, and the kind of limit is in the tool tip
};

/// Returns the full title: "RMS current over 5 s into 500 Ω".
[[nodiscard]] QString rowTitle(const ExposureRow& row);
/// "RMS into 500 Ω": for docks, in which the unit shows whether it is a voltage or a current. The title of a density
/// includes "/cm²".
[[nodiscard]] QString shortRowTitle(const ExposureRow& row);

// Texts for an exposure and its limit: both in the limit's unit, so that the numbers can be compared, with no more
// decimals than are useful next to the limit.

/// "0.69" and "mA" for 690 µA with a limit of 10 mA. "0" for exactly nothing; "< 0.01" for a value too small to show;
/// "> 10" for a value above the limit that would be rounded to the limit. Without a limit: in the value's own unit.
struct ExposureFigure {
    QString number;
    QString unit;  ///< empty if there is no unit
};
[[nodiscard]] ExposureFigure figureOf(const ExposureRow& row);

/// Returns the value with its unit: "0.69 mA".
[[nodiscard]] QString valueText(const ExposureRow& row);
/// "0.69 of 10 mA", "> 10 mA". The limit of a density lacks "/cm²", which is in the title.
[[nodiscard]] QString valueOfLimitText(const ExposureRow& row);
/// "45.3 V measured": the value that an instrument measured; with "⚠" if it differs from the set value by more than the
/// source's accuracy. Empty if nothing was measured.
[[nodiscard]] QString measuredText(const ExposureRow& row);

}  // namespace tacto::gui
