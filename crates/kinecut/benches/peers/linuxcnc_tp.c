/* Runs LinuxCNC's trajectory planner (src/emc/tp) alone over a list of moves, and prints the time that it takes for them. It is
   compiled together with the planner's own sources, by linuxcnc.py beside this file.

   The list comes by standard input, one word and its numbers a line, in mm and s:

       limits AXIS VELOCITY ACCELERATION          of the axes 0 to 5, before the first move
       cycle SECONDS                              servo period
       ahead MOVES                                moves that are added before a cycle: 1 as a control feeds them
       at X Y Z A B C                             where the axes stand
       mode KIND TOLERANCE                        2: blend (G64), 1: exact path (G61), 0: exact stop (G61.1)
       line KIND X Y Z A B C FEED FASTEST ACCELERATION          KIND 1: rapid, 2: feed, 3: arc
       arc X Y Z A B C CX CY CZ NX NY NZ TURN FEED FASTEST ACCELERATION
       wait                                       until nothing is left to run
       positions                                  prints those of every cycle from here on

   A line "time SECONDS MOVES" ends each wait, and the list. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rtapi.h>
#include "motion/motion.h"
#include "tp/tp.h"

void tpMotFunctions(void (*)(int, char), void (*)(int, double), void (*)(int, int), int (*)(int), double (*)(int), double (*)(int));
void tpMotData(emcmot_status_t *, emcmot_config_t *);

static emcmot_status_t status;
static emcmot_config_t config;
static double velocity[9], acceleration[9], cycle = 1e-3;
static int ahead = 1, prints_positions;
static long cycles, moves;
static TP_STRUCT tp;

/* What the planner asks of the rest of LinuxCNC. */
static void no_digital(int pin, char value) { (void)pin; (void)value; }
static void no_analog(int pin, double value) { (void)pin; (void)value; }
static void no_lock(int joint, int unlock) { (void)joint; (void)unlock; }
static int never_locked(int joint) { (void)joint; return 1; }
static double velocity_of(int axis) { return velocity[axis]; }
static double acceleration_of(int axis) { return acceleration[axis]; }

void rtapi_print(const char *format, ...) { (void)format; }
void rtapi_print_msg(msg_level_t level, const char *format, ...) {
    if (level == RTAPI_MSG_ERR) fprintf(stderr, "tp: %s", format);
}

static void fail(const char *what, const char *line) {
    fprintf(stderr, "%s: %s\n", what, line);
    exit(2);
}

static void run_cycle(void) {
    tpRunCycle(&tp, (long)(cycle * 1e9));
    cycles++;
    if (prints_positions) {
        EmcPose at;
        tpGetPos(&tp, &at);
        printf("%.9f %.9f %.9f %.9f\n", cycles * cycle, at.tran.x, at.tran.y, at.tran.z);
    }
}

static void wait(void) {
    while (tcqLen(&tp.queue) > 0) run_cycle();
    printf("time %.6f %ld\n", cycles * cycle, moves);
}

/* A move was added, or was too short to be one. */
static void added(int result, const char *line) {
    if (result < 0) fail("the planner refuses", line);
    moves++;
    if (moves % ahead == 0) run_cycle();
    while (tcqFull(&tp.queue)) run_cycle();
}

static void begin(void) {
    config.arcBlendEnable = 1;
    config.arcBlendOptDepth = 50;
    config.arcBlendGapCycles = 4;
    config.arcBlendRampFreq = 100.0;
    config.arcBlendTangentKinkRatio = 0.1;
    config.maxFeedScale = 1.0;
    config.numSpindles = 1;
    status.net_feed_scale = 1.0;
    status.planner_type = 0;
    status.spindle_status[0].at_speed = 1;
    tpMotFunctions(no_digital, no_analog, no_lock, never_locked, velocity_of, acceleration_of);
    tpMotData(&status, &config);
    if (tpCreate(&tp, DEFAULT_TC_QUEUE_SIZE, 0)) fail("the planner was not made", "");
    tpSetCycleTime(&tp, cycle);
    tpSetVlimit(&tp, 1e9);
    tpSetAmax(&tp, 1e9);
    tpSetVmax(&tp, 1e9, 1e9);
}

/* The numbers behind a word; how many there are. */
static int numbers(const char *from, double *to, int most) {
    int n = 0;
    char *end;
    for (; n < most; n++, from = end) {
        to[n] = strtod(from, &end);
        if (end == from) break;
    }
    return n;
}

static EmcPose pose(const double *n) {
    EmcPose p;
    memset(&p, 0, sizeof p);
    p.tran.x = n[0], p.tran.y = n[1], p.tran.z = n[2], p.a = n[3], p.b = n[4], p.c = n[5];
    return p;
}

int main(void) {
    char line[1024], word[32];
    int has_begun = 0, used;
    struct state_tag_t tag;
    memset(&tag, 0, sizeof tag);
    while (fgets(line, sizeof line, stdin)) {
        double n[20];
        if (sscanf(line, "%31s%n", word, &used) != 1) continue;
        int count = numbers(line + used, n, 20);
#define IS(name, wanted) (!strcmp(word, name) && (count == (wanted) || (fail("numbers are missing or too many", line), 0)))
        if (IS("limits", 3)) { velocity[(int)n[0]] = n[1]; acceleration[(int)n[0]] = n[2]; continue; }
        if (IS("cycle", 1)) { cycle = n[0]; continue; }
        if (IS("ahead", 1)) { ahead = (int)n[0]; continue; }
        if (!has_begun) { begin(); has_begun = 1; }
        if (IS("at", 6)) { EmcPose p = pose(n); tpSetPos(&tp, &p); }
        else if (IS("mode", 2)) tpSetTermCond(&tp, (int)n[0], n[1]);
        else if (IS("line", 10)) added(tpAddLine(&tp, pose(n + 1), (int)n[0], n[7], n[8], n[9], 1e9, 0, 0, -1, tag), line);
        else if (IS("arc", 16)) {
            PmCartesian center = {n[6], n[7], n[8]}, normal = {n[9], n[10], n[11]};
            added(tpAddCircle(&tp, pose(n), center, normal, (int)n[12], 3, n[13], n[14], n[15], 1e9, 0, 0, tag), line);
        }
        else if (IS("wait", 0)) wait();
        else if (IS("positions", 0)) prints_positions = 1;
        else fail("not understood", line);
    }
    if (!has_begun) begin();
    wait();
    return 0;
}
