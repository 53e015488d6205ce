// OverlayState.h - what lies over the traces of an oscilloscope, as ScopeOverlay draws it.
//
// Thread-safety: a value.
#pragma once

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QStringList>
#include <optional>
#include <vector>

#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// Times in seconds on the key axis, heights in divisions above the middle.
struct OverlayState {
    struct Lane {
        QString key;
        QString letter;  ///< "V"
        QColor colour;
        double height = 0;
        bool active = false;
        bool right = false;  ///< its handle stands at the right edge
    };
    struct Trigger {
        std::optional<double> height;  ///< nothing: its channel is not shown
        std::optional<double> moment_s;
        QColor colour;
        bool held = false;  ///< the level follows the command and cannot be dragged
        QString text;       ///< the text shown while it is dragged
    };
    struct Mark {
        double from_s = 0, to_s = 0;
        QString why;
        QColor colour;
    };
    /// A stretch of a trace, from its lowest to its highest.
    struct Drawn {
        double from_s = 0, to_s = 0;
        double low = 0, high = 0;
    };
    /// A cursor's reading; it stands where it hides least of the traces: outside the two cursors, unless there is much
    /// more room between them.
    struct Flag {
        struct Row {
            QString letter;  ///< the lane's letter
            QString text;    ///< "20.1 V ↑"
            QColor colour;
        };
        QString name;      ///< "t₁"
        QString position;  ///< "200.0 µs"
        std::vector<Row> rows;
    };
    /// The next train, or the one that a hand would ask for, in one lane.
    struct Coming {
        std::vector<QPointF> line;  ///< times and heights
        QString text;               ///< "next train 30.7 V" or "by hand: 30.7 V", over the first phase
        QColor colour;
    };
    std::vector<Lane> lanes;
    std::vector<Coming> coming;
    std::optional<Trigger> trigger;
    std::vector<double> timeCursors_s;  ///< two or none
    std::vector<Flag> flags;            ///< the time cursors' flags
    QString timeSpan;                   ///< between them
    std::vector<Drawn> drawn;           ///< the lanes shown, with time cursors
    std::vector<double> levelCursors;   ///< two or none, heights
    std::vector<QString> levelTexts;    ///< the level cursors' texts: "y₁ 40.0 V"
    QString levelSpan;                  ///< between them
    int focusedCursor = -1;             ///< 0, 1: time; 2, 3: level
    std::optional<QRectF> box;          ///< pixels
    std::optional<EdgeReading> hover;
    std::vector<Mark> marks;          ///< in time order
    std::vector<MomentMark> moments;  ///< marks on the time axis
    QStringList notes;                ///< about the whole record: "not triggered", "averaged 16"
    QString alarm;                    ///< the message of a failed mask test, until it is acknowledged
};

/// All but what belongs to one screen: the box of a zoom, and an alarm. Uses the current theme.
[[nodiscard]] OverlayState overlayOf(const ScopeModel& model);

}  // namespace tacto::gui
