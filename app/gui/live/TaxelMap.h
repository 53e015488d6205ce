// TaxelMap.h - the taxels as a small pressure map: a cell each, bluer is more, the value written in.
#pragma once

#include <QWidget>
#include <span>
#include <vector>

namespace tacto::gui {

class TaxelMap final : public QWidget {
    Q_OBJECT
public:
    explicit TaxelMap(QWidget* parent = nullptr);
    /// Newest values above rest, in `unit`; NaN is drawn as absent. The scale grows to the largest ever seen.
    void show(std::span<const float> values, const QString& unit);
    /// The values are old: hatched over.
    void setStale(bool stale);
    [[nodiscard]] bool stale() const { return stale_; }
    void setSimulated(bool simulated);
    void clear();
    /// Cells across and down for `n` taxels: two rows for eight, as on the fingertip; else about square.
    [[nodiscard]] static QSize gridFor(std::size_t n);
    [[nodiscard]] const std::vector<float>& values() const { return values_; }
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    static constexpr std::size_t kUsualTaxels = 8;
    [[nodiscard]] QSize roomFor(int cellHeight) const;
    [[nodiscard]] int captionHeight() const;  ///< height of the line that says what is simulated
    std::vector<float> values_;
    std::vector<float> rest_;  ///< the least seen of each: what it reads with nothing on it
    QString unit_;
    float most_ = 0;
    bool stale_ = false;
    bool simulated_ = false;
};

}  // namespace tacto::gui
