// Graticule.h - ten by eight divisions with the numbers that belong to them, and the ground on which there is no
// record.
//
// Thread-safety: the GUI thread.
#pragma once

#include <qcustomplot.h>
#include <utility>
#include <vector>

namespace tacto::gui {

/// Divides its axis into a fixed number of divisions, wherever it begins, and writes the quantity that stands there:
/// (coordinate - position) · perCoordinate · factor.
class GraticuleTicker final : public QCPAxisTicker {
public:
    explicit GraticuleTicker(int divisions) : divisions_(divisions) {}
    /// `factor` makes the shown unit of the quantity's own (1e3 for ms).
    void setQuantity(double position, double perCoordinate, double factor);
    /// A number at every n-th division only, where there is no room for more.
    void setEvery(int n) { every_ = n; }
    void setBlank(bool blank) { blank_ = blank; }
    void generate(const QCPRange& range, const QLocale& locale, QChar format, int precision, QVector<double>& ticks,
                  QVector<double>* subTicks, QVector<QString>* labels) override;

private:
    const int divisions_;
    double position_ = 0;
    double perCoordinate_ = 1;
    double factor_ = 1;
    int every_ = 1;
    bool blank_ = false;
};

/// Hatches the time for which there is no record: before it, after it, and between two of them.
class RecordGround final : public QCPLayerable {
    Q_OBJECT
public:
    explicit RecordGround(QCPAxis* keyAxis);
    /// From and to on the key axis, in time order. With none, nothing is hatched: an empty plot is just empty.
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
