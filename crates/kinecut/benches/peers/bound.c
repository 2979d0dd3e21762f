/* Lowest heights of a swept ball in f32, by bounds: about the least work that a map of heights asks for. What kinecut's bounds cost
   more than this, they cost for three directions of lines, all tools, proofs and f64.

       gcc -O3 -march=native -ffast-math -fopenmp bound.c -o bound -lm
       bound MOVES.f64 DIAMETER X0,Y0,Z0,X1,Y1,Z1 STEP HEIGHTS.f32

   Moves fall into bins of 32 x 32 columns. A tile of 8 x 8 columns asks each move of its bin for a bound from below, cuts with the
   move of the lowest bound first, then with those only whose bound is below the highest column of the tile. The order of moves has
   no influence. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BIN = 32, TILE = 8, CELLS = TILE * TILE };

typedef struct { float x, y, z, ux, uy, length, slope, low; } Move;

static double clock_of(int which) {
    struct timespec t;
    clock_gettime(which, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static int bin_of(double v, double width, int count) {
    int b = (int)floor(v / width);
    return b < 0 ? 0 : b >= count ? count - 1 : b;
}

/* Move of the plane from record p to q, seen from the corner of a bin; one without a way in the plane is a point at its lower end. */
static Move seen(const double *p, const double *q, double x, double y) {
    double dx = q[1] - p[1], dy = q[2] - p[2], length = hypot(dx, dy);
    Move m = {p[1] - x, p[2] - y, p[3], 1, 0, 0, 0, fmin(p[3], q[3])};
    if (length < 1e-8) { m.z = m.low; return m; }
    m.ux = dx / length; m.uy = dy / length; m.length = length; m.slope = (q[3] - p[3]) / length;
    return m;
}

/* Bound from below of what a move leaves in a tile about (x, y) whose columns are within `reach` of it. */
static float bound(const Move *m, float x, float y, float reach, float radius) {
    float px = x - m->x, py = y - m->y, t = px * m->ux + py * m->uy;
    t = t < 0 ? 0 : t > m->length ? m->length : t;
    float ex = px - t * m->ux, ey = py - t * m->uy, d = sqrtf(ex * ex + ey * ey) - reach;
    d = d < 0 ? 0 : d;
    float left = radius * radius - d * d;
    return left < 0 ? 1e9f : m->low + radius - sqrtf(left);
}

/* Cuts the columns of a tile whose first stands at (x, y); answers the highest of them. */
static float cut(const Move *m, float *z, float x, float y, float step, float radius) {
    float highest = -1e9f, lean = m->slope / sqrtf(1 + m->slope * m->slope);
    for (int j = 0; j < TILE; j++)
        for (int i = 0; i < TILE; i++) {
            float px = x + i * step - m->x, py = y + j * step - m->y;
            float along = px * m->ux + py * m->uy, aside = px * m->uy - py * m->ux;
            float w2 = radius * radius - aside * aside, w = sqrtf(w2 > 0 ? w2 : 0), t = along - w * lean;
            t = t < 0 ? 0 : t > m->length ? m->length : t;
            float e = along - t, left = w2 - e * e;
            float at = m->z + m->slope * t + radius - sqrtf(left > 0 ? left : 0), *c = z + j * TILE + i;
            *c = (left >= 0) & (at < *c) ? at : *c;
            highest = highest > *c ? highest : *c;
        }
    return highest;
}

int main(int count, char **words) {
    if (count < 6) return 2;
    FILE *file = fopen(words[1], "rb");
    if (!file) return 2;
    fseek(file, 0, SEEK_END);
    long moves = ftell(file) / 32;
    rewind(file);
    double *m = malloc(moves * 32), s[6], radius = atof(words[2]) / 2, h = atof(words[4]);
    if (fread(m, 32, moves, file) != (size_t)moves) return 2;
    fclose(file);
    if (sscanf(words[3], "%lf,%lf,%lf,%lf,%lf,%lf", s, s + 1, s + 2, s + 3, s + 4, s + 5) != 6) return 2;
    int nx = lround((s[3] - s[0]) / h), ny = lround((s[4] - s[1]) / h);

    double wall = clock_of(CLOCK_MONOTONIC), cpu = clock_of(CLOCK_PROCESS_CPUTIME_ID), width = BIN * h;
    int bx = (nx + BIN - 1) / BIN, by = (ny + BIN - 1) / BIN, most = 0;
    long *first = calloc((size_t)bx * by + 1, sizeof(long)), *free_at = 0;
    int *order = 0;
    float *heights = malloc((size_t)nx * ny * sizeof(float));
    for (int turn = 0; turn < 2; turn++) {
        if (turn) {
            for (int b = 0; b < bx * by; b++) {
                most = first[b + 1] > most ? first[b + 1] : most;
                first[b + 1] += first[b];
            }
            order = malloc((first[bx * by] + 1) * sizeof(int));
            free_at = malloc((size_t)bx * by * sizeof(long));
            memcpy(free_at, first, (size_t)bx * by * sizeof(long));
        }
        for (long k = 1; k < moves; k++) {
            double *p = m + 4 * k - 4, *q = m + 4 * k;
            double x0 = fmin(p[1], q[1]) - radius - s[0], x1 = fmax(p[1], q[1]) + radius - s[0];
            double y0 = fmin(p[2], q[2]) - radius - s[1], y1 = fmax(p[2], q[2]) + radius - s[1];
            if (fmin(p[3], q[3]) >= s[5] || x1 < 0 || y1 < 0 || x0 > nx * h || y0 > ny * h) continue;
            for (int j = bin_of(y0, width, by); j <= bin_of(y1, width, by); j++)
                for (int i = bin_of(x0, width, bx); i <= bin_of(x1, width, bx); i++)
                    if (turn) order[free_at[j * bx + i]++] = k;
                    else first[j * bx + i + 1]++;
        }
    }
    float round = radius, step = h, reach = (TILE - 1) * 0.5f * step * 1.41422f, top = s[5], bottom = s[2];
#pragma omp parallel
    {
        Move *near = malloc((most + 1) * sizeof(Move));
        float *low = malloc((most + 1) * sizeof(float));
#pragma omp for schedule(dynamic, 4)
        for (int b = 0; b < bx * by; b++) {
            int n = first[b + 1] - first[b], bi = b % bx * BIN, bj = b / bx * BIN;
            for (int e = 0; e < n; e++) {
                long k = order[first[b] + e];
                near[e] = seen(m + 4 * k - 4, m + 4 * k, s[0] + bi * h, s[1] + bj * h);
            }
            for (int tile = 0; tile < BIN / TILE * BIN / TILE; tile++) {
                int ti = tile % (BIN / TILE) * TILE, tj = tile / (BIN / TILE) * TILE, best = -1;
                if (bi + ti >= nx || bj + tj >= ny) continue;
                float z[CELLS], least = top, highest = top, x = (ti + 0.5f) * step, y = (tj + 0.5f) * step;
                float half = (TILE - 1) * 0.5f * step;
                for (int c = 0; c < CELLS; c++) z[c] = top;
                for (int e = 0; e < n; e++) low[e] = bound(near + e, x + half, y + half, reach, round);
                for (int e = 0; e < n; e++)
                    if (low[e] < least) { least = low[e]; best = e; }
                if (best >= 0) highest = cut(near + best, z, x, y, step, round);
                for (int e = 0; e < n; e++)
                    if (low[e] < highest && e != best) highest = cut(near + e, z, x, y, step, round);
                for (int j = 0; j < TILE && bj + tj + j < ny; j++)
                    for (int i = 0; i < TILE && bi + ti + i < nx; i++)
                        heights[(size_t)(bj + tj + j) * nx + bi + ti + i] = fmaxf(z[j * TILE + i], bottom);
            }
        }
    }
    wall = clock_of(CLOCK_MONOTONIC) - wall;
    cpu = clock_of(CLOCK_PROCESS_CPUTIME_ID) - cpu;
    double removed = 0;
    for (long c = 0; c < (long)nx * ny; c++) removed += s[5] - heights[c];
    printf("RESULT {\"wall\": %.4f, \"cpu\": %.4f, \"removed\": %.4f}\n", wall, cpu, removed * (s[3] - s[0]) * (s[4] - s[1]) / nx / ny);
    file = fopen(words[5], "wb");
    return !file || fwrite(heights, sizeof(float), (size_t)nx * ny, file) != (size_t)nx * ny || fclose(file);
}
