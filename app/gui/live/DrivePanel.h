// DrivePanel.h - what drives the output: nothing, two sliders, or the fingertip.
//
// The choice shown is the bench's actual state: the bench turns driving off with every stop, disarm and fault, and the
// panel follows. Only a person's action sends a command to the bench. "By hand" begins with the last values set by hand
// on this bench (at first R = 0 and P = 0), or with the fingertip's values while those are delivered. When the bench
// has turned driving off, the panel says what drove the output, and starts nothing by itself.
#pragma once

#include <QButtonGroup>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <memory>
#include <optional>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

class DrivePanel final : public QWidget {
    Q_OBJECT
public:
    explicit DrivePanel(BenchController& controller, QWidget* parent = nullptr);
    /// Starts anew for another bench, or for none.
    void begin();
    void refresh(const Telemetry& telemetry);
    [[nodiscard]] DriveSource chosen() const;
    /// Returns the output, such as "39.1 V every 770 ms", or "Off".
    [[nodiscard]] QString headline() const { return output_->text(); }

protected:
    /// Arrow keys move between the sources without choosing, so that nothing drives by hand on the way from off to the
    /// fingertip. Return chooses.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Index {
        QSlider* slider = nullptr;
        QDoubleSpinBox* box = nullptr;
        double DriveCommand::*its = nullptr;  ///< a member of BenchController::hand(), never the fingertip's
    };
    void addIndex(QGridLayout& grid, Index& index, const char* objectName, const QString& label, const QString& name,
                  const QString& tip);
    void showHand();
    static void showIndex(const Index& index, double value);
    void choose();
    void drive();
    void follow(DriveSource driving);
    [[nodiscard]] QString outputText(const Telemetry& telemetry) const;
    [[nodiscard]] QString trainText(double amplitude_v, double interval_s) const;
    [[nodiscard]] QString offWords() const;
    [[nodiscard]] QString wasWords() const;
    [[nodiscard]] bool vibrates() const;  ///< a massager replaces the electrodes
    [[nodiscard]] QString words(const Telemetry& telemetry) const;
    void followFinger(const Telemetry& telemetry);

    BenchController& controller_;
    QButtonGroup* sources_;
    QPushButton* off_;
    QPushButton* byHand_;
    QPushButton* finger_;
    Index roughness_{.its = &DriveCommand::roughness}, pressure_{.its = &DriveCommand::pressure};
    std::weak_ptr<BenchTap> bench_;  // the bench on which the values were set
    QLabel* output_;
    QLabel* says_;
    std::optional<DriveSource> asked_;  // the source asked for, until the bench answers
    QElapsedTimer askedAt_;
    std::optional<DriveCommand> was_;      // what drove last on this bench
    DriveSource last_ = DriveSource::Off;  // the source last asked for or reported
};

}  // namespace tacto::gui
