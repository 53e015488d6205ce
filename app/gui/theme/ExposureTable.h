// ExposureTable.h - exposure rows against their limits: quantity, value, limit, and a bar of how much of it is used;
// hatched where a row was not evaluated. In a narrow place the bar stands under the quantity.
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
    /// Rows of one limit set stand under its title, as `sets` has it.
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
    bool compact_ = false;  ///< narrow: the bar under the quantity, what kind of limit it is in the tool tip
};

/// "RMS current over 5 s into 500 Ω".
[[nodiscard]] QString rowTitle(const ExposureRow& row);
/// "RMS into 500 Ω": for a dock, where the unit beside it tells a voltage from a current. A density's title has the
/// "/cm²".
[[nodiscard]] QString shortRowTitle(const ExposureRow& row);

// An exposure against its limit in words: both in the unit of the limit, so that the eye compares numbers, with no more
// decimals than matter beside the limit.

/// "0.69" and "mA" of 690 µA against 10 mA; "0" of nothing at all, "< 0.01" below what is told apart beside the limit,
/// "> 10" where it is above the limit and would read as at it. Without a limit in its own unit.
struct ExposureFigure {
    QString number;
    QString unit;  ///< empty for a number without one
};
[[nodiscard]] ExposureFigure figureOf(const ExposureRow& row);

/// "0.69 mA".
[[nodiscard]] QString valueText(const ExposureRow& row);
/// "0.69 of 10 mA", "> 10 mA". A density's limit is without "/cm²", which its title has.
[[nodiscard]] QString valueOfLimitText(const ExposureRow& row);
/// "45.3 V measured": what an instrument showed of what was set; with "⚠" where the source's accuracy does not explain
/// it. Empty where none did.
[[nodiscard]] QString measuredText(const ExposureRow& row);

}  // namespace tacto::gui
