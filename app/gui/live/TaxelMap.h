// TaxelMap.h - the taxels as a small pressure map: one cell each, bluer for more pressure, with the value inside.
#pragma once

#include <QWidget>
#include <span>
#include <vector>

namespace tacto::gui {

class TaxelMap final : public QWidget {
    Q_OBJECT
public:
    explicit TaxelMap(QWidget* parent = nullptr);
    /// Shows the newest values above rest, in `unit`; NaN is left blank. The scale grows to the largest value seen.
    void show(std::span<const float> values, const QString& unit);
    /// Hatches the map if its values are old.
    void setStale(bool stale);
    [[nodiscard]] bool stale() const { return stale_; }
    void setSimulated(bool simulated);
    void clear();
    /// Returns the columns and rows for `n` taxels: two rows for eight, as on the fingertip; otherwise about square.
    [[nodiscard]] static QSize gridFor(std::size_t n);
    [[nodiscard]] const std::vector<float>& values() const { return values_; }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    static constexpr std::size_t kUsualTaxels = 8;
    [[nodiscard]] QSize roomFor(int cellHeight) const;
    [[nodiscard]] int captionHeight() const;  ///< height of the line that marks a simulation
    std::vector<float> values_;
    std::vector<float> rest_;  ///< each taxel's smallest value seen, taken as its value without load
    QString unit_;
    float most_ = 0;
    bool stale_ = false;
    bool simulated_ = false;
};

}  // namespace tacto::gui
