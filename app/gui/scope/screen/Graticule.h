// Graticule.h - round numbers along the visible part of an axis, and the hatched background where there is no record.
#pragma once

#include <optional>
#include <qcustomplot.h>
#include <utility>
#include <vector>

namespace tacto::gui {

/// Puts numbers and grid lines at multiples of a step of the 1-2-5 ladder: at the divisions if a division is such a
/// step, otherwise at round numbers. The quantity at a coordinate is (coordinate - position) · perCoordinate; it is
/// shown multiplied by `factor`, a power of ten (1e3 for ms).
class RoundTicker final : public QCPAxisTicker {
public:
    /// `divisions`: the largest number of steps along the axis.
    explicit RoundTicker(int divisions) : divisions_(divisions) {}
    void setQuantity(double position, double perCoordinate, double factor);
    /// Sets the least distance between two numbers, in coordinates.
    void setLeast(double coordinates) { least_ = coordinates; }
    void setBlank(bool blank) { blank_ = blank; }
    /// Limits the numbers to low..high and one step beyond on each side, because two lanes share the height. If that
    /// range is out of view, or without a range, the whole axis gets numbers.
    void setNumbered(std::optional<std::pair<double, double>> numbered) { numbered_ = numbered; }
    /// The step, in the quantity's own unit.
    [[nodiscard]] double stepOver(const QCPRange& range) const;
    /// The text of the wider one of the first and the last number.
    [[nodiscard]] QString widestIn(const QCPRange& range) const;
    void generate(const QCPRange& range, const QLocale& locale, QChar format, int precision, QVector<double>& ticks,
                  QVector<double>* subTicks, QVector<QString>* labels) override;

private:
    [[nodiscard]] QString written(double quantity, double step) const;

    const int divisions_;
    double position_ = 0;
    double perCoordinate_ = 1;
    double factor_ = 1;
    double least_ = 0;
    bool blank_ = false;
    std::optional<std::pair<double, double>> numbered_;
};

/// Hatches the times without a record: before, after and between the records.
class RecordGround final : public QCPLayerable {
    Q_OBJECT
public:
    explicit RecordGround(QCPAxis* keyAxis);
    /// Sets start and end of each record on the key axis, in time order. Without records nothing is hatched.
    void setRecords(std::vector<std::pair<double, double>> records) { records_ = std::move(records); }
    void setColour(const QColor& colour) { colour_ = colour; }

protected:
    void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
    void draw(QCPPainter* painter) override;

private:
    QCPAxis* keys_;
    std::vector<std::pair<double, double>> records_;
    QColor colour_;
};

}  // namespace tacto::gui
