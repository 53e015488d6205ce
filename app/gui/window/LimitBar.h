// LimitBar.h - one quantity against its limit: name, bar, value and limit in words.
//
// The bar fills towards the limit, amber from 80 %, red from the limit on. Hatched: not evaluated. No bar: a quantity
// that is shown and has no limit. What was measured stands beside what was set, and is amber where it is not that.
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
    /// Stacked: title, bar, numbers. Line: title and numbers in a line, the bar below, as docks have it.
    enum class Shape { Stacked, Line };
    /// `title` is short: "RMS over 5 s". The tool tip has the full words.
    LimitBar(const QString& title, QWidget* parent = nullptr, Shape shape = Shape::Stacked);
    /// Sets the title where the bar shows another row.
    void setTitle(const QString& title);
    /// Shows a row; nothing: there is no row of this quantity yet (no output is configured). `sets` names the limit by
    /// its title.
    void show(const std::optional<ExposureRow>& row, std::span<const LimitSet> sets = {});
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;
    /// "0.82 of 10 mA", "not evaluated", "–": what is painted, and for screen readers.
    [[nodiscard]] const QString& title() const { return title_; }
    [[nodiscard]] QString text() const { return text_; }
    /// The part of the text that is painted: where there is no room, it lacks the measured value, or has only that
    /// where it differs; else the share in per cent.
    [[nodiscard]] QString shownText() const;
    /// Whether there is room for title and numbers beside each other or, if stacked, above each other.
    [[nodiscard]] bool fits() const;
    /// Share of the limit, 0 to 1 and above; NaN without a limit or a value.
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
    bool broken_ = false;  ///< a limit that refuses is not kept
    QString set_;          ///< the text without what was measured
    QString measured_;     ///< empty where nothing was
    bool beyond_ = false;
};

/// The row of `quantities` that is nearest to its limit, the first of several that are equally near; one that should be
/// evaluated and was not comes before all.
[[nodiscard]] std::optional<ExposureRow> tightest(std::span<const ExposureRow> rows,
                                                  const std::vector<Quantity>& quantities);

/// Limit bars beside each other, as many as fit: those that are nearest to their limits. One that is
/// seen stays until another is clearly nearer. Where there is room for one alone it is narrow, and says its share.
class LimitBarRow final : public QWidget {
public:
    LimitBarRow(const QStringList& titles, QWidget* parent);
    void show(std::size_t index, const std::optional<ExposureRow>& row, std::span<const LimitSet> sets = {}) {
        bars_[index]->show(row, sets);
    }
    void setTitle(std::size_t index, const QString& title) { bars_[index]->setTitle(title); }
    /// Chooses which bars are seen, after the last show().
    void arrange();
    /// The least width in which the nearest limit is shown, in pixels.
    [[nodiscard]] int oneBarWidth() const;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

private:
    std::vector<LimitBar*> bars_;
    std::vector<LimitBar*> seen_;
};

}  // namespace tacto::gui
