// LimitBar.h - shows one quantity and its limit: name, bar, and both values as text.
//
// The bar fills towards the limit: amber from 80 %, red from the limit on. Hatched: not evaluated. No bar: a quantity
// without a limit. A measured value is shown next to the set value, in amber if the two do not match.
#pragma once

#include <QWidget>
#include <optional>
#include <span>
#include <vector>

#include "core/safety/LimitSet.h"

namespace tacto::gui {

class LimitBar final : public QWidget {
    Q_OBJECT
public:
    /// Stacked: title, bar, numbers below each other. Line: title and numbers in a line above the bar, as in docks.
    enum class Shape { Stacked, Line };
    /// `title` is short: "RMS over 5 s". The tool tip has the full name.
    LimitBar(const QString& title, QWidget* parent = nullptr, Shape shape = Shape::Stacked);
    /// Sets the title when the bar shows another row.
    void setTitle(const QString& title);
    /// Shows a row; nothing: no row of this quantity exists yet (no output is configured). `sets` gives the limit's
    /// title.
    void show(const std::optional<ExposureRow>& row, std::span<const LimitSet> sets = {});
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;
    /// "0.82 of 10 mA", "not evaluated", "–": the full text, also for screen readers.
    [[nodiscard]] const QString& title() const { return title_; }
    [[nodiscard]] QString text() const { return text_; }
    /// The text as painted. With too little room: only the set value, or only the measured value if the two do not
    /// match; with still less room the share in per cent.
    [[nodiscard]] QString shownText() const;
    /// True if title and numbers fit, next to each other or, if stacked, one above the other.
    [[nodiscard]] bool fits() const;
    /// Share of the limit: 1 at the limit, above 1 beyond it; NaN without a limit or a value.
    [[nodiscard]] double share() const { return share_; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QString title_;
    Shape shape_;
    QString text_;
    double share_;
    bool known_ = false;
    bool limited_ = false;
    bool evaluated_ = false;
    bool broken_ = false;  ///< a limit that forbids output is exceeded
    QString set_;          ///< the text without the measured value
    QString measured_;     ///< empty if nothing was measured
    bool beyond_ = false;
};

/// Returns the row of `quantities` nearest to its limit, the first one if several are equally near. A row that should
/// be evaluated but was not comes before all others.
[[nodiscard]] std::optional<ExposureRow> tightest(std::span<const ExposureRow> rows,
                                                  const std::vector<Quantity>& quantities);

/// A row of as many limit bars as fit, showing those nearest to their limits. A shown bar stays until another is
/// clearly nearer. If only one fits, it may be narrow and show just its share.
class LimitBarRow final : public QWidget {
public:
    LimitBarRow(const QStringList& titles, QWidget* parent);
    void show(std::size_t index, const std::optional<ExposureRow>& row, std::span<const LimitSet> sets = {}) {
        bars_[index]->show(row, sets);
    }
    void setTitle(std::size_t index, const QString& title) { bars_[index]->setTitle(title); }
    /// Chooses which bars are shown; call it after the last show().
    void arrange();
    /// The least width in pixels that shows the nearest limit.
    [[nodiscard]] int oneBarWidth() const;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

private:
    std::vector<LimitBar*> bars_;
    std::vector<LimitBar*> seen_;
};

}  // namespace tacto::gui
