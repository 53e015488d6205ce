// Strip.h - one strip of the live plots: axes, caption and watermark, a hatch if samples stop coming, and a value axis
// that changes its range in steps instead of all the time.
#pragma once

#include <QStaticText>
#include <qcustomplot.h>
#include <span>
#include <vector>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/RollingGraph.h"

namespace tacto::gui {

/// The line above a strip: its title and unit, a key for each trace, and at the right the newest value. The text is
/// laid out only when a word changes: doing so for every picture, sixty times a second, cost more than drawing the
/// traces.
class StripCaption final : public QCPAbstractItem {
    Q_OBJECT
public:
    /// Owned by the plot of `below`, like every item.
    explicit StripCaption(QCPAxisRect& below);
    /// Applies the current theme and text size.
    void dress();
    [[nodiscard]] int lineHeight() const;

    void setTitle(const QString& text);
    /// Digits have equal widths, so that the value does not jump. A value that describes the picture is less prominent.
    void setValue(const QString& text, bool describes = false);
    [[nodiscard]] QString value() const { return value_.text.text(); }
    /// Sets a key; an empty key takes no room. `brief` replaces `text` if there is no room for all keys.
    void setKey(std::size_t index, const QString& text, const QString& brief = {});
    /// Sets the sample next to the key: a piece of the line, with the mark in its middle.
    void setSample(std::size_t index, const QPen& line, const QCPScatterStyle& mark = QCPScatterStyle::ssNone);

    double selectTest(const QPointF&, bool, QVariant* = nullptr) const override { return -1; }

protected:
    void draw(QCPPainter* painter) override;

private:
    struct Words {
        QStaticText text;
        double width = 0;
    };
    struct Key {
        Words words, brief;
        QPen line{Qt::NoPen};
        QCPScatterStyle mark{QCPScatterStyle::ssNone};
    };
    /// The spacing of the keys: where the keys begin, and the length of each part.
    struct Setting {
        double from, sample, between;
        bool brief;
    };
    [[nodiscard]] static const Words& wordsOf(const Key& key, bool brief);
    [[nodiscard]] double endOf(const Setting& setting) const;
    [[nodiscard]] Setting settingFor(double title, double until) const;
    [[nodiscard]] Key& key(std::size_t index);
    static void set(Words& words, const QString& text, const QFont& font);
    static void layOut(Words& words, const QFont& font);
    void write(QCPPainter& painter, const Words& words, const QFont& font, double x) const;

    QCPAxisRect& below_;
    QFont font_;
    QFont strong_;
    Words title_;
    Words value_;
    bool describes_ = false;
    std::vector<Key> keys_;
};

/// The fixed properties of the value axis.
struct StripAxis {
    double least = 0;  ///< smallest span shown
    bool fromZero = false;
    int ticks = 3;        ///< most ticks
    bool filled = false;  ///< the strip is filled with its picture, so its watermark is an outline on top
};

/// Returns a range in whole steps that contains `wanted`; keeps `before` while it fits and is not too wide.
[[nodiscard]] QCPRange steadyRange(const QCPRange& before, const QCPRange& wanted);

/// Sets `position` to be given by a time of the strip, and by a share of the strip's height from the top.
void placeAcross(QCPItemPosition& position, QCPAxisRect& axes);

/// Ticks in steps of 1, 2, 5, with as many numbers as fit, so that numbers in a low strip do not overlap.
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
    /// Takes `row` of the plot's layout; the plot owns everything created here.
    Strip(QCustomPlot& plot, int row, const QString& title, const StripAxis& axis);

    [[nodiscard]] QCPAxisRect& axes() const { return *axes_; }
    [[nodiscard]] QCPAxis& time() const { return *axes_->axis(QCPAxis::atBottom); }
    [[nodiscard]] QCPAxis& values() const { return *axes_->axis(QCPAxis::atLeft); }
    [[nodiscard]] StripCaption& caption() const { return *caption_; }

    void setPresent(bool present) { present_ = present; }
    [[nodiscard]] bool present() const { return present_; }
    void setSimulated(bool simulated) { simulated_ = simulated; }
    void setFromZero(bool fromZero) { axis_.fromZero = fromZero; }
    /// Returns the range of the value axis, such as "Force (N) 0 to 2"; an axis from zero has a little room below.
    [[nodiscard]] QString scaleText() const;
    void setUnit(const QString& unit) { unit_ = unit; }
    [[nodiscard]] const QString& unit() const { return unit_; }

    /// Takes up space only if the strip is present.
    void layOut();
    /// Applies the current theme and text size.
    void dress();
    /// Draws a line at the time of a fault; NaN: none.
    void markFault(double at_s);
    /// Leaves out value axis numbers for which there is no room.
    void thinTicks();
    /// Fits the value axis to the graphs' values within `time`.
    void fit(std::span<RollingGraph* const> graphs, const QCPRange& time);
    /// Hatches the strip from the last sample on, if that sample is too old.
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
