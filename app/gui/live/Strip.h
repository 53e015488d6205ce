// Strip.h - one strip of the live plots: its axes, caption and watermark, the hatch where no samples come any more, and
// a value axis that steps instead of breathing.
//
// Thread-safety: the GUI thread.
#pragma once

#include <qcustomplot.h>
#include <span>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/RollingGraph.h"
#include "app/gui/live/StripCaption.h"

namespace tacto::gui {

/// What of the value axis is fixed.
struct StripAxis {
    double least = 0;  ///< it never shows a smaller span
    bool fromZero = false;
    int ticks = 3;        ///< at most
    bool filled = false;  ///< by what it shows: its watermark is an outline in front
};

/// The range that `wanted` needs in whole steps; the one `before` stays as long as it fits and is not too wide.
[[nodiscard]] QCPRange steadyRange(const QCPRange& before, const QCPRange& wanted);

/// Steps of 1, 2, 5, as many as there is room for: numbers of a low strip do not lie on each other.
class StripTicker final : public QCPAxisTicker {
public:
    explicit StripTicker(int most) : most_(most) {}
    void setRoom(int numbers) { room_ = numbers; }

protected:
    double getTickStep(const QCPRange& range) override;
    QString getTickLabel(double tick, const QLocale& locale, QChar format, int precision) override;

private:
    const int most_;
    int room_ = 1;
};

class Strip {
public:
    /// In `row` of the plot's layout; what is made here is the plot's.
    Strip(QCustomPlot& plot, int row, const QString& title, const StripAxis& axis);

    [[nodiscard]] QCPAxisRect& axes() const { return *axes_; }
    [[nodiscard]] QCPAxis& time() const { return *axes_->axis(QCPAxis::atBottom); }
    [[nodiscard]] QCPAxis& values() const { return *axes_->axis(QCPAxis::atLeft); }
    [[nodiscard]] StripCaption& caption() const { return *caption_; }

    void setPresent(bool present) { present_ = present; }
    [[nodiscard]] bool present() const { return present_; }
    void setSimulated(bool simulated) { simulated_ = simulated; }
    void setFromZero(bool fromZero) { axis_.fromZero = fromZero; }
    /// "Force (N) 0 to 2": what the value axis shows; one from zero has a little room below it.
    [[nodiscard]] QString scaleText() const;
    void setUnit(const QString& unit) { unit_ = unit; }
    [[nodiscard]] const QString& unit() const { return unit_; }

    /// Takes its room, or none where it is not present.
    void layOut();
    /// In the current theme and text size.
    void dress();
    /// A line at the instant of a fault; NaN: none.
    void markFault(double at_s);
    /// No more numbers at the value axis than have room.
    void thinTicks();
    /// The value axis, to what the graphs show of `time`.
    void fit(std::span<RollingGraph* const> graphs, const QCPRange& time);
    /// Hatched from the last sample on, where that is too old.
    void hatch(const Series* series, double now_s);
    [[nodiscard]] bool stale() const { return present_ && hatch_->visible(); }

private:
    QCPAxisRect* axes_;
    QString title_;
    QString unit_;
    StripAxis axis_;
    QCPItemText* watermark_ = nullptr;
    StripCaption* caption_ = nullptr;
    QCPItemRect* hatch_ = nullptr;
    QCPItemLine* fault_ = nullptr;
    QSharedPointer<StripTicker> ticker_;
    bool present_ = true;
    bool simulated_ = false;
};

}  // namespace tacto::gui
