// Strip.h - one strip of the live plots: its axes, caption and watermark, the hatch where no samples come any more, and
// a value axis that steps instead of breathing.
#pragma once

#include <QStaticText>
#include <qcustomplot.h>
#include <span>
#include <vector>

#include "app/gui/live/LiveHistory.h"
#include "app/gui/live/RollingGraph.h"

namespace tacto::gui {

/// The line above a strip: what it shows and in which unit, a key for each thing drawn in it, and at the right the
/// newest value. Laid out when a word changes, not for every picture: shaping these few words sixty times a second cost
/// more than drawing the traces they name.
class StripCaption final : public QCPAbstractItem {
    Q_OBJECT
public:
    /// Owned by the plot of `below`, as every item is.
    explicit StripCaption(QCPAxisRect& below);
    /// Draws in the current theme and text size.
    void dress();
    [[nodiscard]] int lineHeight() const;

    void setTitle(const QString& text);
    /// Digits have equal widths, so that the value does not jump. A value that describes the picture is drawn fainter.
    void setValue(const QString& text, bool describes = false);
    [[nodiscard]] QString value() const { return value_.text.text(); }
    /// An empty key takes no room. `brief` stands for it where there is no room for all keys.
    void setKey(std::size_t index, const QString& text, const QString& brief = {});
    /// Draws a sample beside the key: a piece of the line, and the mark in its middle.
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
    /// The spacing of the keys: where they begin, and how much each part gets.
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
    double least = 0;  ///< the smallest span that it shows
    bool fromZero = false;
    int ticks = 3;        ///< at most
    bool filled = false;  ///< filled by what it shows: its watermark is an outline in front
};

/// The range that `wanted` needs in whole steps; the one `before` stays as long as it fits and is not too wide.
[[nodiscard]] QCPRange steadyRange(const QCPRange& before, const QCPRange& wanted);

/// `position` is at a time of the strip, and at a share of its height from the top.
void placeAcross(QCPItemPosition& position, QCPAxisRect& axes);

/// Steps of 1, 2, 5, with as many numbers as fit: those of a low strip do not overlap.
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
    /// Takes `row` of the plot's layout; the plot owns what is made here.
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
    /// Draws in the current theme and text size.
    void dress();
    /// A line at the instant of a fault; NaN: none.
    void markFault(double at_s);
    /// Leaves out numbers at the value axis that have no room.
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
