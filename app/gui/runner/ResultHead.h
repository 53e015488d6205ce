// ResultHead.h - shows how a run ended: the verdict in one word, the reasons, and the basis.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "app/gui/controller/BenchController.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/VerdictBlock.h"

namespace tacto::gui {

class ResultHead final : public QWidget {
    Q_OBJECT
public:
    explicit ResultHead(QWidget* parent = nullptr);
    void clear();
    void show(const FinishedRun& run);
    /// Returns the word as shown, such as "PASS".
    [[nodiscard]] QString word() const { return word_; }
    /// Returns the reasons for the verdict and its basis, one per line.
    [[nodiscard]] QStringList reasons() const { return (why_->text() + '\n' + more_->text()).split('\n'); }
    /// Sets whether reasons may be much higher than the verdict; in a low window the plot below needs the room.
    void setRoomy(bool roomy);

signals:
    void scriptErrorChosen(int line, const QString& why);  ///< the operator wants to see the line

private:
    void giveRoom();
    [[nodiscard]] int wholeLines(int wide, int most) const;

    VerdictBlock* verdict_;
    ScrollingPage* area_;
    QLabel* why_;
    QLabel* more_;
    QPushButton* toScript_;
    QString word_;
    QString error_;
    int errorLine_ = 0;
    bool roomy_ = true;
};

}  // namespace tacto::gui
