/* SPDX-License-Identifier: BSD-3-Clause */
/* Simulates an MJCF file by MuJoCo and writes its sensors as CSV to stdout.
 *
 *   simulate MODEL DURATION EVERY [CONTROL]   a row every EVERY steps; CONTROL: rows "time u0 u1 ..."
 *   simulate MODEL mass                       the mass matrix at qpos0, a row a line
 *   simulate version
 *
 * Columns: time [s], the sensors in the file's order (name:component), energy [J] (zero unless
 * the model enables it), contact_force [N] (sum of normal forces of all contacts), contact_depth [m]
 * (the deepest).
 */
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void die(const char* what) {
  fprintf(stderr, "simulate: %s\n", what);
  exit(2);
}

static void write_mass(const mjModel* m, mjData* d) {
  mjtNum* mass = malloc(sizeof(mjtNum) * m->nv * m->nv);
  mj_forward(m, d);
  mj_fullM(m, mass, d->qM);
  for (int i = 0; i < m->nv; ++i) {
    for (int j = 0; j < m->nv; ++j) printf("%.17g ", mass[i * m->nv + j]);
    printf("\n");
  }
  free(mass);
}

static void write_header(const mjModel* m) {
  printf("time");
  for (int i = 0; i < m->nsensor; ++i) {
    for (int k = 0; k < m->sensor_dim[i]; ++k) {
      printf(",%s:%d", m->names + m->name_sensoradr[i], k);
    }
  }
  printf(",energy,contact_force,contact_depth\n");
}

static void write_row(const mjModel* m, const mjData* d, double time) {
  printf("%.12g", time);
  for (int i = 0; i < m->nsensordata; ++i) printf(",%.15g", d->sensordata[i]);
  double force = 0.0, depth = 0.0;
  for (int i = 0; i < d->ncon; ++i) {
    mjtNum wrench[6];
    mj_contactForce(m, d, i, wrench);
    force += wrench[0];
    if (-d->contact[i].dist > depth) depth = -d->contact[i].dist;
  }
  printf(",%.15g,%.15g,%.15g\n", d->energy[0] + d->energy[1], force, depth);
}

/* Controls at a time, linear between rows of `table`. */
static void control(const mjModel* m, mjData* d, const double* table, int rows) {
  const int width = m->nu + 1;
  int i = 0;
  while (i < rows - 2 && table[(i + 1) * width] <= d->time) ++i;
  const double* a = table + i * width;
  const double* b = a + width;
  double s = (d->time - a[0]) / (b[0] - a[0]);
  s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
  for (int k = 1; k < width; ++k) d->ctrl[k - 1] = a[k] + s * (b[k] - a[k]);
}

static double* read_control(const char* path, int width, int* rows) {
  FILE* file = fopen(path, "r");
  if (!file) die("cannot open the control file");
  double* table = malloc(sizeof(double) * 1000000);
  int n = 0;
  while (n < 1000000 && fscanf(file, "%lf", table + n) == 1) ++n;
  fclose(file);
  *rows = n / width;
  if (*rows < 2 || n % width != 0) die("the control file needs a time and all controls a row");
  return table;
}

/* Sensors, forces and contacts are then those at the step's begin. */
static void step(const mjModel* m, mjData* d, int writes) {
  if (m->opt.integrator == mjINT_RK4) { /* its stages overwrite them */
    mjData* copy = writes ? mj_copyData(NULL, m, d) : NULL;
    mj_step(m, d);
    if (copy) {
      mj_forward(m, copy);
      mju_copy(d->sensordata, copy->sensordata, m->nsensordata);
      mju_copy(d->energy, copy->energy, 2);
      mj_deleteData(copy);
    }
  } else {
    mj_step1(m, d);
    mj_step2(m, d);
  }
}

int main(int argc, char** argv) {
  if (argc == 2 && strcmp(argv[1], "version") == 0) {
    printf("%s\n", mj_versionString());
    return 0;
  }
  if (argc < 3) die("usage: simulate MODEL DURATION EVERY [CONTROL] | MODEL mass | version");
  char error[1000] = "";
  mjModel* m = mj_loadXML(argv[1], NULL, error, sizeof error);
  if (!m) die(error);
  mjData* d = mj_makeData(m);
  if (m->nkey > 0) mj_resetDataKeyframe(m, d, 0);
  if (strcmp(argv[2], "mass") == 0) {
    write_mass(m, d);
    return 0;
  }
  if (argc < 4) die("DURATION needs EVERY");
  const long steps = (long)(atof(argv[2]) / m->opt.timestep + 0.5);
  const long every = atol(argv[3]);
  int rows = 0;
  double* table = argc > 4 ? read_control(argv[4], m->nu + 1, &rows) : NULL;
  write_header(m);
  for (long i = 0; i <= steps; ++i) {
    if (table) control(m, d, table, rows);
    const double time = d->time;
    step(m, d, i % every == 0);
    if (i % every == 0) write_row(m, d, time);
    if (d->warning[mjWARN_BADQACC].number > 0) die("unstable: bad acceleration");
  }
  free(table);
  mj_deleteData(d);
  mj_deleteModel(m);
  return 0;
}
