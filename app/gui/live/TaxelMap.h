// TaxelMap.h - the taxels as a small pressure map: a cell each, darker is more, the value written in.
//
// Thread-safety: the GUI thread.
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
    void clear();
    [[nodiscard]] const std::vector<float>& values() const { return values_; }
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    std::vector<float> values_;
    std::vector<float> rest_;  ///< the least seen of each: what it reads with nothing on it
    QString unit_;
    float most_ = 0;
};

}  // namespace tacto::gui
