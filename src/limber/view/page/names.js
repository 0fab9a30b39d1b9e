// Names of links over the picture; one that would overlap another is left out.
import * as THREE from 'three';

export class Names {
  /// @param legend an element beside it that names must leave free
  constructor(element, links, legend) {
    this.element = element;
    this.legend = legend;
    this.isShown = false;
    this.items = links.map((link) => {
      const label = document.createElement('span');
      label.textContent = link.short;
      element.append(label);
      return { link, label };
    });
    element.hidden = true;
  }

  toggle() {
    this.isShown = !this.isShown;
    this.element.hidden = !this.isShown;
  }

  update(camera, width, height) {
    if (!this.isShown) return;
    const { offsetLeft: x, offsetTop: y, offsetWidth: w, offsetHeight: h } = this.legend;
    const taken = [{ x, y, w, h }]; // nothing while it is hidden
    for (const { link, label } of this.items) {
      const place = new THREE.Vector3().setFromMatrixPosition(link.group.matrixWorld).project(camera);
      const w = label.offsetWidth;
      const h = label.offsetHeight;
      const x = ((place.x + 1) / 2) * width - w / 2;
      const y = ((1 - place.y) / 2) * height - h / 2;
      const overlaps = taken.some(
        (o) => x < o.x + o.w + 4 && o.x < x + w + 4 && y < o.y + o.h + 2 && o.y < y + h + 2);
      const isOut = place.z > 1 || x < 0 || y < 0 || x + w > width || y + h > height;
      const isVisible = link.group.visible && !overlaps && !isOut;
      label.style.visibility = isVisible ? 'visible' : 'hidden';
      if (!isVisible) continue;
      label.style.transform = `translate(${x}px, ${y}px)`;
      taken.push({ x, y, w, h });
    }
  }
}
