// Graticule.h - round numbers along any visible part of an axis, and the ground on which there is no record.
#pragma once

#include <optional>
#include <qcustomplot.h>
#include <utility>
#include <vector>

namespace tacto::gui {

/// Puts numbers, and with them the lines of the grid, where the quantity is a multiple of a step of the 1-2-5 ladder:
/// at the divisions where a division is such a step, otherwise where the numbers are round. The quantity at a
/// coordinate is (coordinate - position) · perCoordinate; it is written times `factor`, a power of ten (1e3 for ms).
class RoundTicker final : public QCPAxisTicker {
public:
    /// `divisions`: as many steps fit the axis at most.
    explicit RoundTicker(int divisions) : divisions_(divisions) {}
    void setQuantity(double position, double perCoordinate, double factor);
    /// Numbers are at least so far apart, in coordinates.
    void setLeast(double coordinates) { least_ = coordinates; }
    void setBlank(bool blank) { blank_ = blank; }
    /// Only what lies around low..high gets numbers, to the next step beyond either, as two lanes share the height.
    /// Where nothing of that is in view, or for nothing, everything gets numbers.
    void setNumbered(std::optional<std::pair<double, double>> numbered) { numbered_ = numbered; }
    /// The step, in the quantity's own unit.
    [[nodiscard]] double stepOver(const QCPRange& range) const;
    /// The wider of the two numbers at the ends, as it would be written.
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

/// Hatches the time for which there is no record: before it, after it, and between two of them.
class RecordGround final : public QCPLayerable {
    Q_OBJECT
public:
    explicit RecordGround(QCPAxis* keyAxis);
    /// Each record's beginning and end on the key axis, in time order. Without records nothing is hatched.
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
