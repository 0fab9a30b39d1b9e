// Material that moves a surface by its modes and colours it by a field, both in
// the vertex shader.
import * as THREE from 'three';

/// The field that needs modal velocities, and that which only results with stress
/// have.
export const kVelocityField = 3;
export const kStressField = 4;

/// Fields by which surfaces are coloured; `index` is that of the shader.
export const kFields = [
  { name: 'none', label: 'by link', unit: '', index: 0 },
  { name: 'deformation', label: 'deformation', unit: 'm', index: 1 },
  { name: 'displacement', label: 'displacement from the start', unit: 'm', index: 2 },
  { name: 'velocity', label: 'velocity', unit: 'm/s', index: kVelocityField },
  { name: 'von_mises', label: 'von Mises stress', unit: 'Pa', index: kStressField },
];

const kDeclarations = /* glsl */ `
uniform int limberField;
uniform float limberMagnification;
uniform vec3 limberVelocity;  // body frame
uniform vec3 limberSpin;      // body frame
uniform mat4 limberBack;      // from the body frame to that of the start
uniform vec2 limberRange;
#ifdef LIMBER_MODES
uniform float limberRates[LIMBER_MODES];
uniform float limberStart[LIMBER_MODES];
#endif
#ifdef LIMBER_STRESS
attribute float limberStress;
#endif
#ifdef LIMBER_DEFORMED  // by the processor
attribute vec3 limberDeformation;  // magnified
attribute vec3 limberDeformationRate;
attribute vec3 limberDeformationStart;
#endif
varying float limberValue;
`;

// One fetch of a mode serves the deformation, its rate and that of the start.
const kMotion = /* glsl */ `
vec3 limberX = transformed;
vec3 limberU = vec3(0.0);
vec3 limberUdot = vec3(0.0);
vec3 limberU0 = vec3(0.0);
#ifdef LIMBER_DEFORMED
limberU = limberDeformation;
limberUdot = limberDeformationRate;
limberU0 = limberDeformationStart;
#elif defined(LIMBER_MODES)
int limberRow = gl_VertexID / morphTargetsTextureSize.x;
ivec2 limberTexel = ivec2(gl_VertexID - limberRow * morphTargetsTextureSize.x, limberRow);
if (limberField < 2) {
  for (int i = 0; i < LIMBER_MODES; i++) {
    limberU += texelFetch(morphTargetsTexture, ivec3(limberTexel, i), 0).xyz *
               morphTargetInfluences[i];
  }
} else {
  for (int i = 0; i < LIMBER_MODES; i++) {
    vec3 shape = texelFetch(morphTargetsTexture, ivec3(limberTexel, i), 0).xyz;
    limberU += shape * morphTargetInfluences[i];
    limberUdot += shape * limberRates[i];
    limberU0 += shape * limberStart[i];
  }
}
#endif
transformed = limberX + limberU;
limberU /= limberMagnification;
float limberSize = 0.0;
if (limberField == 1) limberSize = length(limberU);
if (limberField == 2) {
  vec3 now = (limberBack * vec4(limberX + limberU, 1.0)).xyz;
  limberSize = distance(now, limberX + limberU0);
}
if (limberField == 3) {
  limberSize = length(limberVelocity + cross(limberSpin, limberX + limberU) + limberUdot);
}
#ifdef LIMBER_STRESS
if (limberField == 4) limberSize = limberStress;
#endif
limberValue = (limberSize - limberRange.x) / (limberRange.y - limberRange.x);
`;

const kColour = /* glsl */ `
#ifdef LIMBER_STRESS
bool limberHasField = limberField > 0;
#else
bool limberHasField = limberField > 0 && limberField != 4;
#endif
if (limberHasField) {
  diffuseColor.rgb = texture2D(limberMap, vec2(clamp(limberValue, 0.002, 0.998), 0.5)).rgb;
}
`;

/// Uniforms that every surface of a page shares.
export function makeSharedUniforms(map) {
  return {
    limberField: { value: 0 },
    limberMagnification: { value: 1 },
    limberRange: { value: new THREE.Vector2(0, 1) },
    limberMap: { value: map },
  };
}

/// @param shared makeSharedUniforms(), or null: one colour, such as a ghost's
/// @param hasStress whether its geometry has the attribute limberStress
export function makeMaterial(colour, modes, shared, hasStress) {
  const material = new THREE.MeshLambertMaterial({
    color: colour,
    flatShading: true,
  });
  const own = {
    limberVelocity: { value: new THREE.Vector3() },
    limberSpin: { value: new THREE.Vector3() },
    limberBack: { value: new THREE.Matrix4() },
  };
  if (modes > 0) {
    own.limberRates = { value: new Float32Array(modes) };
    own.limberStart = { value: new Float32Array(modes) };
    material.defines = { LIMBER_MODES: modes };
    if (hasStress) material.defines.LIMBER_STRESS = '';
  }
  material.userData.own = own;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, shared, own);
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${kDeclarations}`)
      .replace('#include <morphtarget_vertex>', kMotion);
    shader.fragmentShader = shader.fragmentShader
      .replace(
        '#include <common>',
        '#include <common>\nuniform int limberField;\nuniform sampler2D limberMap;\nvarying float limberValue;',
      )
      .replace('#include <color_fragment>', `#include <color_fragment>\n${kColour}`);
  };
  material.customProgramCacheKey = () => `limber${modes}${hasStress ? 'stress' : ''}`;
  return material;
}
