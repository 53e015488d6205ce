// DrivePanel.h - what drives the output: nothing, two sliders, or the fingertip.
//
// What is chosen here is what the bench does: the bench turns driving off with every stop, disarm and fault, and the
// panel follows it. Only a person's hand on a control asks anything of the bench.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QButtonGroup>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <optional>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class DrivePanel final : public QWidget {
    Q_OBJECT
public:
    explicit DrivePanel(BenchController& controller, QWidget* parent = nullptr);
    /// Another bench, or none.
    void begin();
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] DriveSource chosen() const;
    /// "39.1 V every 770 ms", "Off".
    [[nodiscard]] QString headline() const { return output_->text(); }

protected:
    /// Arrows go from source to source without choosing: on the way from off to the fingertip nothing drives by hand.
    /// Return chooses.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Index {
        QSlider* slider;
        QDoubleSpinBox* box;
    };
    [[nodiscard]] Index addIndex(QGridLayout& grid, int row, const QString& label, const QString& name,
                                 const QString& tip);
    void drive();
    void follow(DriveSource driving);
    [[nodiscard]] QString outputText(const Telemetry& telemetry) const;
    [[nodiscard]] bool vibrates() const;  ///< a massager in place of the electrodes
    [[nodiscard]] QString words(const Telemetry& telemetry) const;
    void followFinger(const Telemetry& telemetry);

    BenchController& controller_;
    QButtonGroup* sources_;
    QPushButton* off_;
    QPushButton* byHand_;
    QPushButton* finger_;
    Index roughness_{}, pressure_{};
    QLabel* output_;
    QLabel* says_;
    std::optional<DriveSource> asked_;  // of the bench, which has not answered yet
    QElapsedTimer askedAt_;
};

}  // namespace tacto::gui
