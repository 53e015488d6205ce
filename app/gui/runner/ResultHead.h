// ResultHead.h - how a run ended: the verdict in a word, then why, then what it rests on.
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
    /// "PASS", as it stands there.
    [[nodiscard]] QString word() const { return word_; }
    /// The reasons for the verdict and what it rests on, a line each.
    [[nodiscard]] QStringList reasons() const { return (why_->text() + '\n' + more_->text()).split('\n'); }
    /// Whether reasons may be much higher than the verdict's word: in a low window the plot below needs the room.
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
